#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "service/encoded_records.h"
#include "service/lru_cache.h"
#include "service/method_request.h"
#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/method/method_result.h"
#include "vsplit/quality/mesh_quality.h"

namespace vsplit::service {

/// A finished representation of a session. What it says never changes, so readers share it without waiting; the meshes of the
/// levels asked for last are kept. Thread-safe.
class Representation {
public:
    /// `source` as used, defaults filled in.
    Representation(std::string id, MeshRef source, MethodResult result);

    [[nodiscard]] const std::string& id() const { return id_; }
    [[nodiscard]] const MeshRef& source() const { return source_; }
    [[nodiscard]] const MethodResult& result() const { return result_; }
    [[nodiscard]] const MultiresMesh& mrr() const { return result_.mrr; }

    /// The level to use for `faces`: the nearest that exists; 0 means the resolution it was made for. O(log(levels)).
    [[nodiscard]] std::size_t level_for(std::uint32_t faces) const;

    /// Heavy unless cached: O(records up to it). \pre level <= mrr().levels().
    [[nodiscard]] std::shared_ptr<const TriangleMesh> mesh(std::size_t level) const;

    /// The records in an encoding; those asked for last are kept. Heavy unless kept: O(records). \pre as for EncodedRecords.
    [[nodiscard]] std::shared_ptr<EncodedRecords> encoded(const EncodingChoice& choice) const;

    /// Heavy: O(records up to it + faces log faces). \pre as for `mesh`.
    [[nodiscard]] Quality quality(std::size_t level) const;

private:
    const std::string id_;
    const MeshRef source_;
    const MethodResult result_;
    mutable LruCache<TriangleMesh> meshes_;
    mutable LruCache<std::shared_ptr<EncodedRecords>> encoded_;
};

}  // namespace vsplit::service
