#include "io/model_3mf.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "io/mesh_builder.h"
#include "io/read_error.h"
#include "io/text_lines.h"

namespace vsplit {
namespace {

constexpr std::array<std::pair<std::string_view, LengthUnit>, 6> kUnits = {{{"micron", LengthUnit::kMicrometre},
                                                                            {"millimeter", LengthUnit::kMillimetre},
                                                                            {"centimeter", LengthUnit::kCentimetre},
                                                                            {"meter", LengthUnit::kMetre},
                                                                            {"inch", LengthUnit::kInch},
                                                                            {"foot", LengthUnit::kFoot}}};

/// Extensions that a file may require: all that they add to the shape is read, or they add nothing to it.
constexpr std::array<std::string_view, 3> kKnownExtensions = {
    "http://schemas.microsoft.com/3dmanufacturing/production/2015/06",
    "http://schemas.microsoft.com/3dmanufacturing/material/2015/02",
    "http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07"};

constexpr std::string_view kCoreNamespace = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";

/// Without the prefix that says which namespace it is of.
std::string_view local_name(std::string_view name) { return name.substr(name.find(':') + 1); }

/// Reads one model file, tag by tag.
class ModelFile {
public:
    ModelFile(std::string part, XmlStream xml, Room3mf& room) : xml_(std::move(xml)), room_(room), builder_(room.faces) {
        model_.part = std::move(part);
    }

    Expected<Model3mf> read() {
        for (;;) {
            const Expected<std::optional<XmlTag>> tag = xml_.next();
            if (!tag) return tag.error();
            if (!*tag && !begun_) return error(at_line(1), Cause::kUnknownFormat, "expected a tag <model>; the file has none");
            if (!*tag) return std::move(model_);
            if (Status taken = take(**tag); !taken) return taken.error();
        }
    }

private:
    Status take(const XmlTag& tag) {
        if (!begun_) return take_model(tag);
        const std::string_view name = core_name(tag.name);
        if (tag.ends) return name == "object" ? end_object() : Status(Done{});
        if (name == "vertex") return take_vertex(tag);
        if (name == "triangle") return take_triangle(tag);
        if (name == "object") return begin_object(tag);
        if (name == "component") return take_component(tag);
        if (name == "item") return take_item(tag);
        const std::string_view local = local_name(tag.name);
        if (local == "triangleset") return begin_set(tag);
        if (local == "ref" || local == "refrange") return take_members(tag);
        return Done{};
    }

    /// The name of a tag of the core's namespace without its prefix; empty for others.
    [[nodiscard]] std::string_view core_name(std::string_view name) const {
        const std::string_view local = local_name(name);
        const std::string_view prefix = name.substr(0, name.size() - local.size());
        const bool is_core = std::find(core_prefixes_.begin(), core_prefixes_.end(), prefix) != core_prefixes_.end();
        return is_core ? local : std::string_view();
    }

    /// Tags without a prefix are the core's whatever is declared, as most readers have it.
    void find_core_prefixes(const XmlTag& model) {
        constexpr std::string_view kDeclares = "xmlns:";
        core_prefixes_.emplace_back();
        for (const auto& [key, value] : model.attributes) {
            if (key.starts_with(kDeclares) && value == kCoreNamespace)
                core_prefixes_.push_back(std::string(key.substr(kDeclares.size())) + ":");
        }
    }

    Status take_model(const XmlTag& tag) {
        find_core_prefixes(tag);
        if (core_name(tag.name) != "model")
            return error(tag.place, Cause::kUnknownFormat, "expected a tag <model>, found <" + std::string(tag.name) + ">");
        begun_ = true;
        if (const std::string_view unit = tag.attribute("unit"); !unit.empty()) {
            const auto* const known =
                std::find_if(kUnits.begin(), kUnits.end(), [unit](const auto& u) { return u.first == unit; });
            if (known == kUnits.end()) {
                return error(tag.place, Cause::kMalformedInput,
                             "expected a unit (micron, millimeter, centimeter, inch, foot, meter), " + found(unit));
            }
            model_.unit = known->second;
        }
        std::string_view required = tag.attribute("requiredextensions");
        for (std::string_view prefix = next_word(required); !prefix.empty(); prefix = next_word(required)) {
            const std::string_view extension = tag.attribute("xmlns:" + std::string(prefix));
            if (std::find(kKnownExtensions.begin(), kKnownExtensions.end(), extension) != kKnownExtensions.end()) continue;
            return error(
                tag.place, Cause::kUnsupported,
                "the file requires an extension of 3MF that is not read: " + quoted(extension.empty() ? prefix : extension));
        }
        return Done{};
    }

    Status begin_object(const XmlTag& tag) {
        if (object_) return error(tag.place, Cause::kMalformedInput, "an object begins within another one");
        if (Status one = take_part(tag); !one) return one;
        Object3mf& object = object_.emplace();
        const Expected<std::uint64_t> id = number(tag, "id", 0xFFFFFFFFU);
        if (!id) return id.error();
        object.id = *id;
        object.place = tag.place;
        object.name = xml_unescaped(tag.attribute("name"));
        const std::string_view type = tag.attribute("type");
        object.is_support = type == "support" || type == "solidsupport";
        builder_ = MeshBuilder(room_.faces);
        return tag.closed ? end_object() : Status(Done{});
    }

    Status end_object() {
        if (!object_) return Done{};
        room_.faces -= builder_.face_count();
        Expected<TriangleMesh> mesh = builder_.take();
        if (!mesh) return mesh.error();
        object_->mesh = *std::move(mesh);
        for (const TriangleSet3mf& set : object_->sets) {
            for (const auto& range : set.ranges) {
                if (range.second < object_->mesh.face_count()) continue;
                return error(object_->place, Cause::kIndexOutOfRange,
                             "a set of the object names triangle " + std::to_string(range.second) + ", and it has " +
                                 std::to_string(object_->mesh.face_count()));
            }
        }
        model_.objects.push_back(*std::move(object_));
        object_.reset();
        return Done{};
    }

    Status take_vertex(const XmlTag& tag) {
        if (!object_) return outside(tag);
        if (room_.vertices == 0)
            return error(tag.place, Cause::kLimitExceeded, "there are over three vertices for each face that is accepted");
        --room_.vertices;
        constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
        Vec3 position;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::string_view text = tag.attribute(kAxes[axis]);
            const std::optional<double> value = parse_number(text);
            if (!value) return attribute_error(tag, kAxes[axis], text, "a number");
            position[static_cast<Eigen::Index>(axis)] = *value;
        }
        return builder_.add_vertex(position, tag.place);
    }

    Status take_triangle(const XmlTag& tag) {
        if (!object_) return outside(tag);
        constexpr std::array<std::string_view, 3> kCorners = {"v1", "v2", "v3"};
        Triangle corners{};
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::string_view text = tag.attribute(kCorners[corner]);
            const std::optional<std::int64_t> index = parse_integer(text);
            if (!index) return attribute_error(tag, kCorners[corner], text, "the number of a vertex");
            if (*index < 0 || *index >= builder_.vertex_count()) return index_error(*index, builder_.vertex_count(), tag.place);
            corners[corner] = static_cast<std::uint32_t>(*index);
        }
        return builder_.add_polygon(corners, tag.place);
    }

    Status begin_set(const XmlTag& tag) {
        if (!object_) return outside(tag);
        if (Status one = take_part(tag); !one) return one;
        object_->sets.push_back({xml_unescaped(tag.attribute("name")), {}});
        return Done{};
    }

    Status take_members(const XmlTag& tag) {
        if (!object_ || object_->sets.empty()) return Done{};  // of an extension that has such tags too
        const bool one = local_name(tag.name) == "ref";
        const Expected<std::uint64_t> first = number(tag, one ? "index" : "startindex", 0xFFFFFFFEU);
        if (!first) return first.error();
        const Expected<std::uint64_t> last = one ? first : number(tag, "endindex", 0xFFFFFFFEU);
        if (!last) return last.error();
        if (*first > *last) {
            return error(tag.place, Cause::kMalformedInput,
                         "a range of triangles goes from " + std::to_string(*first) + " to " + std::to_string(*last));
        }
        const std::uint64_t members = *last - *first + 1;
        if (members > room_.memberships)
            return error(tag.place, Cause::kLimitExceeded, "the sets of the file have over 100 million members");
        room_.memberships -= members;
        object_->sets.back().ranges.emplace_back(static_cast<std::uint32_t>(*first), static_cast<std::uint32_t>(*last));
        return Done{};
    }

    Status take_component(const XmlTag& tag) {
        if (!object_) return outside(tag);
        Expected<Reference3mf> component = reference(tag);
        if (!component) return component.error();
        object_->components.push_back(*std::move(component));
        return Done{};
    }

    Status take_item(const XmlTag& tag) {
        Expected<Reference3mf> item = reference(tag);
        if (!item) return item.error();
        model_.items.push_back(*std::move(item));
        return Done{};
    }

    /// An object, a component, an item or a set more.
    Status take_part(const XmlTag& tag) {
        if (room_.parts == 0)
            return error(tag.place, Cause::kLimitExceeded, "there are over a million objects, components, items and sets");
        --room_.parts;
        return Done{};
    }

    Expected<Reference3mf> reference(const XmlTag& tag) {
        if (Status one = take_part(tag); !one) return one.error();
        const Expected<std::uint64_t> id = number(tag, "objectid", 0xFFFFFFFFU);
        if (!id) return id.error();
        Reference3mf result{{}, *id, {}, tag.place};
        for (const auto& [key, value] : tag.attributes) {  // of the production extension, whatever its prefix
            if (key.ends_with(":path")) result.part = xml_unescaped(value.substr(value.starts_with('/') ? 1 : 0));
        }
        const std::string_view transform = tag.attribute("transform");
        if (transform.empty()) return result;
        const Expected<Placement3mf> placement = placement_of(tag, transform);
        if (!placement) return placement.error();
        result.placement = *placement;
        return result;
    }

    /// Twelve numbers: what the axes become, then the shift.
    static Expected<Placement3mf> placement_of(const XmlTag& tag, std::string_view text) {
        std::array<double, 12> numbers{};
        std::string_view rest = text;
        for (double& value : numbers) {
            const std::optional<double> parsed = parse_number(next_word(rest));
            if (!parsed || !std::isfinite(*parsed)) return attribute_error(tag, "transform", text, "12 numbers");
            value = *parsed;
        }
        if (!trimmed(rest).empty()) return attribute_error(tag, "transform", text, "12 numbers");
        Placement3mf placement;
        for (Eigen::Index i = 0; i < 9; ++i) placement.linear(i % 3, i / 3) = numbers[static_cast<std::size_t>(i)];
        placement.shift = {numbers[9], numbers[10], numbers[11]};
        if (placement.linear.determinant() != 0) return placement;
        return error(tag.place, Cause::kMalformedInput, "the transform flattens what it is put on: its determinant is 0");
    }

    static Expected<std::uint64_t> number(const XmlTag& tag, std::string_view key, std::uint32_t most) {
        const std::string_view text = tag.attribute(key);
        const std::optional<std::int64_t> value = parse_integer(text);
        if (value && *value >= 0 && *value <= std::int64_t{most}) return static_cast<std::uint64_t>(*value);
        return attribute_error(tag, key, text, "an integer from 0 to " + std::to_string(most));
    }

    static Error attribute_error(const XmlTag& tag, std::string_view key, std::string_view text, const std::string& expected) {
        return error(tag.place, Cause::kMalformedInput,
                     "expected " + expected + " as " + std::string(key) + " of <" + std::string(tag.name) + ">, " +
                         (text.empty() ? "found none" : found(text)));
    }

    static Error outside(const XmlTag& tag) {
        return error(tag.place, Cause::kMalformedInput, "<" + std::string(tag.name) + "> stands outside of an object");
    }

    static Error error(Place place, Cause cause, const std::string& what) { return read_error(cause, place, what); }

    XmlStream xml_;
    Room3mf& room_;
    MeshBuilder builder_;  // of the object that is begun
    std::optional<Object3mf> object_;
    std::vector<std::string> core_prefixes_;  // with their colons
    bool begun_ = false;
    Model3mf model_;
};

}  // namespace

Expected<Model3mf> read_model_3mf(std::string part, XmlStream xml, Room3mf& room) {
    const std::string name = part;
    Expected<Model3mf> model = ModelFile(std::move(part), std::move(xml), room).read();
    if (model) return model;
    Error error = model.error();
    error.message = name + ", " + error.message;
    return error;
}

std::string_view unit_name_3mf(LengthUnit unit) {
    return std::find_if(kUnits.begin(), kUnits.end(), [unit](const auto& known) { return known.second == unit; })->first;
}

}  // namespace vsplit
