#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

#include "vsplit/base/expected.h"
#include "vsplit/io/mesh_format.h"
#include "vsplit/mesh/length_unit.h"
#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/mrr/multires_mesh.h"
#include "vsplit/mrr/record_block.h"
#include "vsplit/v1/meshing.pb.h"

namespace vsplit::client {

/// For TlsOptions::ca: those that the machine trusts.
inline constexpr std::string_view kSystemAuthorities = "system";

/// Files of TLS, PEM each; all empty: a plain connection.
struct TlsOptions {
    std::string ca;    ///< authorities, one of which must have signed the server's certificate; or kSystemAuthorities
    std::string cert;  ///< for a server that wants the client's certificate
    std::string key;   ///< of `cert`
};

struct ConnectOptions {
    std::chrono::milliseconds timeout{5000};  ///< how long to try; a port that refuses is told at once
    std::stop_token stop;                     ///< as in CallOptions
    TlsOptions tls{};
    std::string token{};        ///< goes with every call; over a plain connection everybody on the way can read it
    std::string traceparent{};  ///< goes with every call, as W3C's Trace Context has it; empty: none
};

/// What happens when a server cannot be reached (UNAVAILABLE): one that starts again is waited for.
struct RetryOptions {
    int attempts = 5;                          ///< tries in a row that bring nothing before the error is given up to; >= 1
    std::chrono::milliseconds first_wait{20};  ///< before the second try; each further wait is twice as long
    std::chrono::milliseconds longest_wait{2000};
};

/// What every call takes.
struct CallOptions {
    /// Longest the whole call may take, retries included (DEADLINE_EXCEEDED beyond); empty: as long as it needs.
    std::optional<std::chrono::milliseconds> deadline;

    /// `std::stop_source::request_stop()` on any thread cancels the call: it returns CANCELLED, and the server stops working.
    std::stop_token stop;

    /// Of calls that are safe to make twice: those that only read, KeepAlive and DeleteSession. Others are made once.
    RetryOptions retry{};
};

/// How an upload is to be read by the server.
struct UploadOptions {
    std::optional<MeshFormat> format;  ///< told from the bytes when empty
    double weld = 0;                   ///< length, model units, >= 0; 0 merges exactly equal vertices
    v1::Repair repair = v1::REPAIR_UNSPECIFIED;
    std::optional<double> stitch{};      ///< with FULL, length >= 0: borders this close are joined; default 0.2 % of the diagonal
    std::optional<double> hole_size{};   ///< with FULL, length >= 0: holes with a box of at most this diagonal are filled; 5 %
    std::optional<double> speck_size{};  ///< with FULL, length >= 0: pieces with a box of a smaller diagonal are dropped; 0.1 %
    std::optional<LengthUnit> unit{};    ///< of the file's lengths, where it does not say it
    std::function<void(std::uint64_t sent, std::uint64_t total)> on_progress;  ///< bytes; called on the caller's thread
};

/// What a stream begins with.
struct StreamBase {
    TriangleMesh mesh;               ///< the coarsest, its positions on `grid`
    std::uint32_t ghosts = 0;        ///< how many of its first vertices close boundaries; see MultiresMesh
    PositionGrid grid;               ///< the positions that the stream's encoding can hold
    double max_error = 0;            ///< no coordinate of the stream differs from the exact one by more; model units
    std::uint32_t first_record = 0;  ///< 0, or of a keyframe, a mesh of a finer level: the first record that it has not in it
    std::uint32_t splits = 0;        ///< how many the stream means to bring after it; 0 where that is not known
};

/// Who hears of a stream's events, on the thread that made the call. Empty handlers are skipped. A handler that returns an error
/// ends the call with that error.
struct EventHandlers {
    std::function<void(const v1::Progress&)> on_progress;
    /// Once, whole, before any record; sizes are checked, indices and `ghosts` are not.
    std::function<Status(StreamBase base)> on_base_mesh;
    /// A block as it came; RecordCodec decodes it, on the mesh that the base and the blocks before it made.
    std::function<Status(const RecordBlock& block)> on_block;
    /// A part of the regions, after the base mesh and before records, where there are any.
    std::function<Status(const v1::Regions& part)> on_regions{};
};

}  // namespace vsplit::client
