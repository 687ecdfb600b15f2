#include "grpc/download_stream.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "guard/digest.h"
#include "service/guarded.h"
#include "service/memory_use.h"
#include "vsplit/base/execution_context.h"
#include "vsplit/io/second_order.h"
#include "vsplit/io/write_mesh.h"
#include "wire/convert.h"
#include "wire/error_table.h"

namespace vsplit::rpc {
namespace {

Expected<service::FileMapping> map_file(std::string_view text, const std::filesystem::path& directory) {
    Expected<service::TempFile> file = service::TempFile::create(directory);
    if (!file) return file.error();
    if (Status written = file->append(std::as_bytes(std::span(text))); !written) return written.error();
    return file->map();
}

/// What a download asked for.
struct Wanted {
    service::PickedMesh mesh;
    MeshFormat format{};
    std::shared_ptr<const service::SourceMesh> surface;  ///< of order 2: where mid-side nodes go
    std::optional<LengthUnit> unit;                      ///< of the file's lengths; empty: as the mesh
};

/// Mid-side nodes on the surface, where they are wanted.
Expected<std::optional<MidsideNodes>> nodes_of(const TriangleMesh& mesh, const Wanted& wanted) {
    if (!wanted.surface) return std::optional<MidsideNodes>();
    const Expected<std::shared_ptr<const TriangleMesh>> surface = wanted.surface->mesh->get();
    if (!surface) return surface.error();
    Expected<MidsideNodes> nodes = midside_nodes(mesh, **surface, ExecutionContext({}, 1));
    if (!nodes) return nodes.error();
    return std::optional(*std::move(nodes));
}

/// \param make_room called where the disk is full
Expected<MeshFile> write_file(const Wanted& wanted, const std::filesystem::path& directory, service::MemoryBudget& memory,
                              const std::function<void()>& make_room) {
    const Expected<service::OpenedMesh> opened = wanted.mesh.open();
    if (!opened) return opened.error();
    const std::uint32_t faces = opened->ref.faces;
    const Expected<service::MemoryBudget::Share> room = memory.borrow(service::memory_to_write(faces, wanted.surface ? 2 : 1),
                                                                      "writing a file of " + std::to_string(faces) + " faces");
    if (!room) return room.error();
    MeshFile file;
    file.facts.mesh = opened->ref;
    std::shared_ptr<const TriangleMesh> mesh = opened->mesh;
    Expected<std::optional<MidsideNodes>> nodes = nodes_of(*mesh, wanted);
    if (!nodes) return nodes.error();
    const std::optional<LengthUnit> from = wanted.mesh.unit();
    const std::optional<LengthUnit> to = wanted.unit ? wanted.unit : from;
    if (from != to) {
        auto converted = std::make_shared<TriangleMesh>(*mesh);
        convert_lengths(converted->positions, *from, *to);
        if (*nodes) convert_lengths((*nodes)->positions, *from, *to);
        mesh = std::move(converted);
    }
    if (*nodes) file.facts.nodes_on_chord = (*nodes)->on_chord;
    Expected<std::string> text =
        *nodes ? write_second_order(*mesh, **nodes, wanted.format) : Expected<std::string>(write_mesh(*mesh, wanted.format, to));
    if (!text) return text.error();
    file.facts.size = text->size();
    file.facts.digest = guard::hex_digits(guard::digest_of(*text));
    Expected<service::FileMapping> mapped = map_file(*text, directory);
    if (!mapped) {
        make_room();
        mapped = map_file(*text, directory);
    }
    if (mapped) {
        file.mapping.emplace(*std::move(mapped));
    } else {
        file.text = *std::move(text);
    }
    return file;
}

/// Whether a download may be of that order. \return INVALID_OPTION, UNSUPPORTED (order).
Status check_order(std::uint32_t order, MeshFormat format) {
    if (order > 2) return Error{Cause::kInvalidOption, "order is " + std::to_string(order) + "; accepted are 1 and 2", "order"};
    if (order == 2 && !has_second_order(format)) return write_second_order({}, {}, format).error();
    return Done{};
}

const char* content_type(MeshFormat format) {
    switch (format) {
        case MeshFormat::kStlBinary:
        case MeshFormat::kStlAscii:
            return "model/stl";
        case MeshFormat::kObj:
            return "model/obj";
        case MeshFormat::kPlyAscii:
        case MeshFormat::kOff:
        case MeshFormat::kMshAscii:
        case MeshFormat::kMsh2Ascii:
        case MeshFormat::kInp:
        case MeshFormat::kBdf:
        case MeshFormat::kVtkAscii:
            return "text/plain";
        case MeshFormat::k3mf:
            return "model/3mf";
        case MeshFormat::kPlyBinary:
        case MeshFormat::kMsh:
        case MeshFormat::kMsh2:
        case MeshFormat::kVtk:
        case MeshFormat::kVtu:
            break;
    }
    return "application/octet-stream";  // these have no registered type
}

// E.g. "r1-5000.stl", "mesh-1234.ply". A format's name is its extension, with "-ascii" after it where there are two kinds, and a
// 2 where there are two versions.
std::string file_name(const service::MeshRef& mesh, MeshFormat format) {
    const std::string_view name = format == MeshFormat::kMsh2 || format == MeshFormat::kMsh2Ascii ? "msh" : format_name(format);
    return (mesh.representation.empty() ? std::string("mesh") : mesh.representation) + '-' + std::to_string(mesh.faces) + '.' +
           std::string(name.substr(0, name.find('-')));
}

FileName name_of(const service::SessionSnapshot& session, const v1::DownloadMeshRequest& request, MeshFormat format,
                 std::optional<LengthUnit> unit) {
    std::ostringstream text;
    text << session.id << ' ' << request.representation() << ' ' << request.faces() << ' ' << static_cast<int>(format) << ' '
         << request.order() << ' ' << (unit ? static_cast<int>(*unit) : -1);
    return {text.str(), session.source};
}

void tell(const FileFacts& facts, MeshFormat format, v1::MeshChunk& chunk) {
    chunk.set_size(facts.size);
    chunk.set_file_name(file_name(facts.mesh, format));
    chunk.set_faces(facts.mesh.faces);
    chunk.set_nodes_on_chord(facts.nodes_on_chord);
    chunk.set_digest(facts.digest);
}

/// What is known of a file that is not to be made: its type at least.
class DescriptionSource final : public MessageSource<v1::MeshChunk> {
public:
    DescriptionSource(MeshFormat format, std::optional<FileFacts> facts) : format_(format), facts_(std::move(facts)) {}

    [[nodiscard]] Step next(v1::MeshChunk& chunk, grpc::Status& /*end*/) override {
        if (std::exchange(told_, true)) return Step::kEnd;
        chunk.set_content_type(content_type(format_));
        if (facts_) tell(*facts_, format_, chunk);
        return Step::kMessage;
    }

private:
    const MeshFormat format_;
    const std::optional<FileFacts> facts_;
    bool told_ = false;
};

/// Whether the disk has room for a file that nobody reads, which must keep no upload out.
bool has_room(const std::filesystem::path& directory, std::uint64_t bytes) {
    constexpr std::uint64_t kTimes = 10;
    std::error_code failed;
    const auto place = directory.empty() ? std::filesystem::temp_directory_path(failed) : directory;
    const std::filesystem::space_info space = std::filesystem::space(place, failed);
    return !failed && space.available / kTimes >= bytes;
}

/// Begins to write the file that `shared` waits for. False when the server is shut down.
bool begin_file(service::MeshingService& service, const std::weak_ptr<FileShelf>& weak_shelf, const FileName& name,
                const std::shared_ptr<SharedFile>& shared, const Wanted& wanted) {
    return service.errand([name, wanted, waited_for = std::weak_ptr(shared), weak_shelf, &service] {
        const std::filesystem::path& directory = service.options().temp_directory;
        const std::shared_ptr<SharedFile> file = waited_for.lock();
        if (!file) return;
        const auto make_room = [&] {
            if (const std::shared_ptr<FileShelf> shelf = weak_shelf.lock()) shelf->clear();
        };
        Expected<MeshFile> made = service::guarded([&] { return write_file(wanted, directory, service.memory(), make_room); });
        const std::shared_ptr<FileShelf> shelf = weak_shelf.lock();
        if (made && shelf) {
            // Memory is for those alone who read it now.
            const bool rests = made->mapping && has_room(directory, made->facts.size);
            shelf->made(name, file, made->facts, rests ? FileShelf::Rest::kYes : FileShelf::Rest::kNo);
        }
        file->put(std::move(made));
    });
}

}  // namespace

Expected<std::unique_ptr<MessageSource<v1::MeshChunk>>> DownloadSource::make(service::MeshingService& service,
                                                                             const std::shared_ptr<FileShelf>& shelf,
                                                                             const service::Caller& caller,
                                                                             const v1::DownloadMeshRequest& request, Want want,
                                                                             const Wake& wake) {
    const Expected<std::optional<MeshFormat>> asked = wire::from_proto(request.format());
    if (!asked) return asked.error();
    const MeshFormat format = asked->value_or(MeshFormat::kStlBinary);
    if (Status possible = check_order(request.order(), format); !possible) return possible.error();
    const Expected<std::optional<LengthUnit>> unit = wire::from_proto(request.unit());
    if (!unit) return unit.error();
    const Expected<service::SessionSnapshot> session = service.snapshot(request.session(), caller);
    if (!session) return session.error();
    Expected<service::PickedMesh> mesh = service::PickedMesh::pick(*session, {request.representation(), request.faces()});
    if (!mesh) return mesh.error();
    if (Status possible = check_unit(format, mesh->unit(), *unit); !possible) return possible.error();
    const FileName name = name_of(*session, request, format, *unit);
    if (want == Want::kDescription) {
        return std::unique_ptr<MessageSource>(std::make_unique<DescriptionSource>(format, shelf->find(name)));
    }
    const Wanted wanted{*mesh, format, request.order() == 2 ? session->source : nullptr, *unit};
    auto [file, first] = shelf->join(name);
    file->call_when_there(wake);
    std::unique_ptr<MessageSource> source(new DownloadSource(format, file));
    if (first && !begin_file(service, shelf, name, file, wanted)) {
        file->put(Error{Cause::kUnavailable, "the server is shutting down", ""});
    }
    return source;
}

DownloadSource::Step DownloadSource::next(v1::MeshChunk& chunk, grpc::Status& end) {
    const Expected<MeshFile>* const file = shared_->get();
    if (file == nullptr) return Step::kWait;
    if (!*file) {
        end = wire::to_status(file->error());
        return Step::kEnd;
    }
    if (std::exchange(begun_, true) && sent_ == (*file)->bytes().size()) return Step::kEnd;
    fill(**file, chunk);
    return Step::kMessage;
}

void DownloadSource::fill(const MeshFile& file, v1::MeshChunk& chunk) {
    chunk.Clear();
    const std::span<const std::byte> rest = file.bytes().subspan(sent_);
    const std::span<const std::byte> part = rest.first(std::min(rest.size(), kChunkBytes));
    chunk.set_offset(sent_);
    chunk.set_data(part.data(), part.size());
    if (sent_ == 0) {
        chunk.set_content_type(content_type(format_));
        tell(file.facts, format_, chunk);
    }
    sent_ += part.size();
}

}  // namespace vsplit::rpc
