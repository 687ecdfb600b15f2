// How fast a server sends records to one client, how soon the first block comes, and what readers that stall cost it, on a
// representation that it holds; then how soon a client that holds nothing has a mesh, by records, by files and by other people's
// codecs: tables in Markdown. bench_stream HOST:PORT SESSION PID, PID the server's on this machine.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <latch>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "records/file_server.h"
#include "records/mesh_codecs.h"
#include "vsplit/client/mesh_receiver.h"
#include "vsplit/client/meshing_client.h"
#include "vsplit/io/read_mesh.h"

namespace {

using namespace vsplit;
using Clock = std::chrono::steady_clock;

constexpr int kRounds = 20;
constexpr int kStalled = 6;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Bytes of memory that a process has in use; 0 where /proc does not say.
double resident_bytes(const std::string& pid) {
    std::ifstream file("/proc/" + pid + "/statm");
    double size = 0, resident = 0;
    file >> size >> resident;
    return resident * 4096;
}

[[noreturn]] void stop(const Error& error) {
    std::fprintf(stderr, "bench_stream: %s\n", error.message.c_str());
    std::exit(1);
}

/// All records, to a client that holds the base mesh.
v1::SetResolutionRequest all_records(const std::string& session, v1::RecordEncoding encoding, const v1::Representation& made) {
    v1::SetResolutionRequest request;
    request.set_session(session);
    request.set_faces_held(made.faces_min());
    request.set_faces(made.faces_max());
    request.set_encoding(encoding);
    return request;
}

/// Processor seconds that a process has used, this one without `pid`; 0 where /proc does not say.
double processor_seconds(const std::string& pid = "self") {
    std::ifstream file("/proc/" + pid + "/stat");
    std::string stat((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    std::istringstream fields(stat.substr(std::min(stat.rfind(')') + 1, stat.size())));
    std::string skipped;
    for (int field = 0; field < 11; ++field) fields >> skipped;
    double user = 0, kernel = 0;
    fields >> user >> kernel;
    return (user + kernel) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

struct Stream {
    double payload = 0, first_block = 0, last_block = 0, end = 0;  ///< bytes, seconds; it ends with figures of the level
};

Stream receive(client::MeshingClient& client, const v1::SetResolutionRequest& request) {
    Stream stream;
    const Clock::time_point start = Clock::now();
    client::EventHandlers handlers;
    handlers.on_block = [&](const RecordBlock& block) -> Status {
        if (stream.payload == 0) stream.first_block = seconds_since(start);
        stream.payload += static_cast<double>(block.payload.size());
        stream.last_block = seconds_since(start);
        return Done{};
    };
    if (const auto done = client.set_resolution(request, handlers); !done) stop(done.error());
    stream.end = seconds_since(start);
    return stream;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

struct Meshes {
    double first = 0, last = 0;  ///< seconds until a mesh can be shown, and until that which was asked for
};

/// Decoded, to a client that holds nothing.
Meshes receive_mesh(client::MeshingClient& client, const v1::SetResolutionRequest& request) {
    Meshes meshes;
    client::MeshReceiver receiver;
    const Clock::time_point start = Clock::now();
    client::EventHandlers handlers = receiver.handlers();
    handlers.on_base_mesh = [&](client::StreamBase base) -> Status {
        Status begun = receiver.begin(std::move(base));
        meshes.first = meshes.last = seconds_since(start);
        return begun;
    };
    handlers.on_block = [&](const RecordBlock& block) -> Status {
        Status appended = receiver.append(block);
        meshes.last = seconds_since(start);
        return appended;
    };
    if (const auto done = client.set_resolution(request, handlers); !done) stop(done.error());
    return meshes;
}

client::MeshingClient connected(const std::string& server) {
    auto client = client::MeshingClient::connect(server);
    if (!client) stop(client.error());
    return *std::move(client);
}

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

TriangleMesh read_file(const std::filesystem::path& file) {
    auto read = read_mesh_file(file, {});
    if (!read) stop(read.error());
    return std::move(read->mesh);
}

/// As a file, which is read into an indexed mesh, to a client that holds nothing.
template <class Read>
Meshes download(client::MeshingClient& client, const v1::DownloadMeshRequest& request, const Read& read) {
    const std::filesystem::path file = std::filesystem::temp_directory_path() / ("bench_stream_" + std::to_string(::getpid()));
    const Clock::time_point start = Clock::now();
    const auto faces = client.download_mesh(request, file);
    if (!faces) stop(faces.error());
    const TriangleMesh mesh = read(file);
    const double seconds = seconds_since(start);
    std::filesystem::remove(file);
    if (mesh.face_count() != *faces) stop({Cause::kCorrupt, "a file has not the faces that were sent", ""});
    return {seconds, seconds};
}

/// `beforehand`: how long it took to encode, for what was encoded before anybody asked.
template <class Fetch>
void print_meshes(const char* name, const std::string& beforehand, const Fetch& fetch) {
    const Meshes unmade = fetch();
    std::vector<double> first, last;
    for (int round = 0; round < kRounds; ++round) {
        const Meshes meshes = fetch();
        first.push_back(meshes.first * 1e3);
        last.push_back(meshes.last * 1e3);
    }
    std::printf("| %s | %s | %.1f, %.1f | %.1f, %.1f |\n", name, beforehand.c_str(), unmade.first * 1e3, median(first),
                unmade.last * 1e3, median(last));
}

void print_records(client::MeshingClient& client, const v1::SetResolutionRequest& level) {
    for (const auto& [name, encoding, bits] : {std::tuple("records, FLOAT64", v1::FLOAT64, 0U),
                                               {"records, FLOAT32", v1::FLOAT32, 0U},
                                               {"records, 14 bits", v1::QUANTISED, 14U}}) {
        v1::SetResolutionRequest request = level;
        request.set_encoding(encoding);
        request.set_quantisation_bits(bits);
        print_meshes(name, "-", [&] { return receive_mesh(client, request); });
    }
}

void print_files(client::MeshingClient& client, v1::DownloadMeshRequest request) {
    for (const auto& [name, format] : {std::pair("binary STL", v1::STL), {"binary PLY", v1::PLY}}) {
        request.set_format(format);
        print_meshes(name, "-", [&] { return download(client, request, read_file); });
    }
}

struct MeshCodec {
    const char* name;
    std::string (*encode)(const TriangleMesh&);
    TriangleMesh (*decode)(std::string_view);
};

/// The server has no such file: it is encoded beforehand, and comes from this process over a connection of the same kind.
void print_codec(const MeshCodec& codec, const TriangleMesh& mesh) {
    std::vector<double> encoding;
    std::string file;
    for (int round = 0; round < kRounds; ++round) {
        const Clock::time_point start = Clock::now();
        file = codec.encode(mesh);
        encoding.push_back(seconds_since(start) * 1e3);
    }
    const BoundingBox sent = bounding_box(mesh), got = bounding_box(codec.decode(file));
    if (!((sent.min - got.min).cwiseAbs().maxCoeff() <= (sent.max - sent.min).maxCoeff() / 16383 &&
          (sent.max - got.max).cwiseAbs().maxCoeff() <= (sent.max - sent.min).maxCoeff() / 16383))
        stop({Cause::kCorrupt, std::string(codec.name) + ": what comes back is elsewhere", ""});
    const bench::FileServer server(std::move(file), mesh.face_count());
    client::MeshingClient client = connected(server.address());
    char beforehand[32];
    std::snprintf(beforehand, sizeof(beforehand), "%.1f", median(encoding));
    const auto read = [&codec](const std::filesystem::path& path) { return codec.decode(bytes_of(path)); };
    print_meshes(codec.name, beforehand, [&] { return download(client, {}, read); });
}

/// How soon a client has a level, by all the ways there are.
void print_all_meshes(client::MeshingClient& client, const std::string& session, const std::string& representation,
                      std::uint32_t faces) {
    std::printf(
        "\n| %u faces, as | Encoded beforehand, ms | A mesh to show, ms: first time, median of %d | The mesh asked for, ms |\n"
        "|---|--:|--:|--:|\n",
        faces, kRounds);
    v1::SetResolutionRequest level;
    level.set_session(session);
    level.set_representation(representation);
    level.set_faces(faces);
    print_records(client, level);
    v1::DownloadMeshRequest file;
    file.set_session(session);
    file.set_representation(representation);
    file.set_faces(faces);
    print_files(client, file);
    client::MeshReceiver receiver;
    if (const auto done = client.set_resolution(level, receiver.handlers()); !done) stop(done.error());
    print_codec({"Draco, 14 bits", bench::encode_draco, bench::decode_draco}, receiver.mesh());
    print_codec({"meshoptimizer, 14 bits", bench::encode_meshoptimizer, bench::decode_meshoptimizer}, receiver.mesh());
}

/// Bytes of the server's memory for each of several readers that take one block and then none.
double cost_of_stalled(const std::string& server, const std::string& pid, const v1::SetResolutionRequest& request) {
    const double before = resident_bytes(pid);
    std::latch begun(kStalled), over(1);
    std::vector<std::thread> readers;
    for (int i = 0; i < kStalled; ++i) {
        readers.emplace_back([&] {
            client::MeshingClient client = connected(server);
            bool first = true;
            client::EventHandlers handlers;
            handlers.on_block = [&](const RecordBlock&) -> Status {
                if (std::exchange(first, false)) begun.count_down();
                over.wait();
                return Done{};
            };
            if (const auto done = client.set_resolution(request, handlers); !done) stop(done.error());
        });
    }
    begun.wait();
    std::this_thread::sleep_for(std::chrono::seconds(3));
    const double after = resident_bytes(pid);
    over.count_down();
    for (std::thread& reader : readers) reader.join();
    return (after - before) / kStalled;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) {
        std::fprintf(stderr, "usage: bench_stream HOST:PORT SESSION PID\n");
        return 2;
    }
    const std::string server = argv[1], session = argv[2], pid = argv[3];
    client::MeshingClient client = connected(server);
    v1::SetResolutionRequest coarsest;
    coarsest.set_session(session);
    const auto made = client.set_resolution(coarsest);
    if (!made) stop(made.error());
    std::printf(
        "| Encoding | Faces | Payload, MB | First stream, MB/s | MB/s, median of %d | First block, ms: first, median, most |"
        " Figures at the end, ms: first, median | CPU seconds a GB: server, client | MB of the server a stalled reader |\n"
        "|---|--:|--:|--:|--:|--:|--:|--:|--:|\n",
        kRounds);
    for (const auto encoding : {v1::FLOAT64, v1::FLOAT32, v1::QUANTISED}) {
        const v1::SetResolutionRequest request = all_records(session, encoding, *made);
        const Stream first = receive(client, request);
        std::vector<double> rates, waits, ends;
        const double server_before = processor_seconds(pid), client_before = processor_seconds();
        for (int round = 0; round < kRounds; ++round) {
            const Stream again = receive(client, request);
            rates.push_back(again.payload / again.last_block / 1e6);
            ends.push_back(again.end * 1e3);
            waits.push_back(again.first_block * 1e3);
        }
        const double gigabytes = kRounds * first.payload / 1e9;
        const double server_cost = (processor_seconds(pid) - server_before) / gigabytes;
        const double client_cost = (processor_seconds() - client_before) / gigabytes;
        std::printf("| %s | %u | %.1f | %.0f | %.0f | %.1f, %.1f, %.1f | %.1f, %.1f | %.1f, %.1f | %.2f |\n",
                    v1::RecordEncoding_Name(encoding).c_str(), made->faces_max(), first.payload / 1e6,
                    first.payload / first.last_block / 1e6, median(rates), first.first_block * 1e3, median(waits),
                    *std::max_element(waits.begin(), waits.end()), first.end * 1e3, median(ends), server_cost, client_cost,
                    cost_of_stalled(server, pid, request) / 1e6);
    }
    print_all_meshes(client, session, made->id(), std::clamp(30'000U, made->faces_min(), made->faces_max()));
}
