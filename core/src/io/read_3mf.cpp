#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "io/assembly_3mf.h"
#include "io/model_3mf.h"
#include "io/read_error.h"
#include "io/readers.h"
#include "io/text_lines.h"
#include "io/xml_stream.h"
#include "io/zip_reader.h"
#include "vsplit/io/read_mesh.h"

namespace vsplit {
namespace {

constexpr std::string_view kModelType = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
constexpr std::string_view kUsualModel = "3D/3dmodel.model";

/// A triangle takes some 60 bytes of XML, and half a vertex as many.
constexpr std::uint64_t kMostBytesAFace = 256;
constexpr std::uint64_t kMostBytesBeside = std::uint64_t{1} << 20U;

/// Opens parts of an archive within a limit of what they unpack to.
class Parts {
public:
    Parts(const ZipReader& archive, std::uint32_t max_faces)
        : archive_(archive), most_(kMostBytesBeside + kMostBytesAFace * max_faces), left_(most_) {}

    Expected<XmlStream> open(const ZipEntry& entry) {
        if (entry.size > left_) {
            return read_error(Cause::kLimitExceeded, at_byte(static_cast<std::size_t>(entry.at)),
                              vsplit::quoted(entry.name) + " unpacks to " + std::to_string(entry.size) + " bytes; at most " +
                                  std::to_string(most_) + " of XML are accepted for the faces that are");
        }
        left_ -= entry.size;
        Expected<ZipStream> bytes = archive_.unpack(entry);
        if (!bytes) return bytes.error();
        return XmlStream(*std::move(bytes));
    }

private:
    const ZipReader& archive_;
    std::uint64_t most_;
    std::uint64_t left_;
};

/// The name of the root model: as the archive's relationships say, or the usual one.
Expected<std::string> root_of(const ZipReader& archive, Parts& parts) {
    const ZipEntry* relationships = archive.find("_rels/.rels");
    if (relationships == nullptr) return std::string(kUsualModel);
    Expected<XmlStream> xml = parts.open(*relationships);
    if (!xml) return xml.error();
    std::optional<std::string> root;
    for (;;) {  // to the end, where the checksum is
        const Expected<std::optional<XmlTag>> tag = xml->next();
        if (!tag) return tag.error();
        if (!*tag) return root.value_or(std::string(kUsualModel));
        if (root || (*tag)->attribute("Type") != kModelType) continue;
        const std::string target = xml_unescaped((*tag)->attribute("Target"));
        root = target.substr(target.starts_with('/') ? 1 : 0);
    }
}

/// Parts that a model names beside itself, each once, in whichever case.
std::vector<std::string> parts_named(const Model3mf& model) {
    std::map<std::string, std::string> names{{upper_case(model.part), model.part}};
    const auto take = [&](const Reference3mf& reference) {
        if (!reference.part.empty()) names.try_emplace(upper_case(reference.part), reference.part);
    };
    for (const Object3mf& object : model.objects) std::for_each(object.components.begin(), object.components.end(), take);
    std::for_each(model.items.begin(), model.items.end(), take);
    names.erase(upper_case(model.part));
    std::vector<std::string> parts;
    for (const auto& [key, name] : names) parts.push_back(name);
    return parts;
}

}  // namespace

Expected<TriangleMesh> read_3mf(std::span<const std::byte> bytes, const ReadOptions& options, std::optional<LengthUnit>& unit) {
    const Expected<ZipReader> archive = ZipReader::open(bytes);
    if (!archive) return archive.error();
    Parts parts(*archive, options.max_faces);
    Room3mf room(options.max_faces);
    const auto read = [&](const std::string& name) -> Expected<Model3mf> {
        const ZipEntry* entry = archive->find(name);
        if (entry == nullptr)
            return Error{Cause::kMalformedInput, "the archive has no " + vsplit::quoted(name) + ", which it names", ""};
        Expected<XmlStream> xml = parts.open(*entry);
        if (!xml) return xml.error();
        return read_model_3mf(name, *std::move(xml), room);
    };
    const Expected<std::string> root = root_of(*archive, parts);
    if (!root) return root.error();
    if (archive->find(*root) == nullptr) {
        return Error{Cause::kUnknownFormat,
                     "byte 0: the bytes are a zip archive without a 3MF model (" + vsplit::quoted(*root) + "); unpack it first",
                     ""};
    }
    std::vector<Model3mf> models;
    Expected<Model3mf> first = read(*root);
    if (!first) return first.error();
    models.push_back(*std::move(first));
    for (const std::string& name : parts_named(models.front())) {
        Expected<Model3mf> model = read(name);
        if (!model) return model.error();
        if (model->unit != models.front().unit) {
            return Error{Cause::kMalformedInput,
                         name + " is in " + std::string(unit_symbol(model->unit)) + ", and " + *root + " in " +
                             std::string(unit_symbol(models.front().unit)),
                         ""};
        }
        models.push_back(*std::move(model));
    }
    unit = models.front().unit;
    return assemble_3mf(models, options);
}

}  // namespace vsplit
