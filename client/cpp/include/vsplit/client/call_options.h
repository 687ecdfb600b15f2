#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>

#include "vsplit/base/expected.h"
#include "vsplit/io/mesh_format.h"
#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/mrr/multires_mesh.h"
#include "vsplit/v1/meshing.pb.h"

namespace vsplit::client {

struct ConnectOptions {
    std::chrono::milliseconds timeout{5000};  ///< how long to try; a port that refuses is told at once
    std::stop_token stop;                     ///< as in CallOptions
};

/// What every call takes.
struct CallOptions {
    /// Longest the whole call may take (DEADLINE_EXCEEDED beyond); empty: as long as it needs.
    std::optional<std::chrono::milliseconds> deadline;

    /// `std::stop_source::request_stop()` on any thread cancels the call: it returns CANCELLED, and the server stops working.
    std::stop_token stop;
};

/// How an upload is to be read by the server.
struct UploadOptions {
    std::optional<MeshFormat> format;  ///< told from the bytes when empty
    double weld = 0;                   ///< length, model units, >= 0; 0 merges exactly equal vertices
    v1::Repair repair = v1::REPAIR_UNSPECIFIED;
    std::function<void(std::uint64_t sent, std::uint64_t total)> on_progress;  ///< bytes; called on the caller's thread
};

/// Who hears of a stream's events, on the thread that made the call. Empty handlers are skipped. A handler that returns an error
/// ends the call with that error.
struct EventHandlers {
    std::function<void(const v1::Progress&)> on_progress;
    /// Once, whole, before any record; sizes are checked, indices and `ghosts` (see MultiresMesh) are not.
    std::function<Status(TriangleMesh base, std::uint32_t ghosts)> on_base_mesh;
    /// A block, its checksum verified; `first` is the number of its first record.
    std::function<Status(std::uint32_t first, const RecordSpan& records)> on_records;
    /// A part of the regions, after the base mesh and before records, where there are any.
    std::function<Status(const v1::Regions& part)> on_regions{};
};

}  // namespace vsplit::client
