#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "service/method_request.h"
#include "service/representation.h"
#include "service/source_mesh.h"
#include "vsplit/base/expected.h"

/// What the service holds as the text of the index, and back. Every reader returns CORRUPT for what no writer of ours has made.
namespace vsplit::store {

[[nodiscard]] std::string write_source(const service::SourceMesh& source, const TriangleMesh& mesh, std::uint64_t blob_bytes);

/// What is told of a source, without its mesh.
struct ToldSource {
    MeshReport report;
    std::vector<FaceSet> sets;
    std::uint64_t memory = 0;
    std::uint64_t blob_bytes = 0;
};
[[nodiscard]] Expected<ToldSource> read_source(const std::string& text);

[[nodiscard]] std::string write_request(const service::MethodRequest& request);
[[nodiscard]] Expected<service::MethodRequest> read_request(const std::string& text);

[[nodiscard]] std::string write_representation(const service::Representation& representation, std::uint64_t blob_bytes);

/// What is told of a representation, without its levels.
struct ToldRepresentation {
    std::string id;
    service::MethodRequest asked;
    MethodFigures figures;
    MrrExtent extent;
    std::uint64_t memory = 0;
    std::uint64_t blob_bytes = 0;
};
[[nodiscard]] Expected<ToldRepresentation> read_representation(const std::string& text);

}  // namespace vsplit::store
