#include "wire/enum_value.h"

#include <algorithm>
#include <optional>

#include "vsplit/io/mesh_format.h"
#include "vsplit/mesh/length_unit.h"
#include "vsplit/v1/meshing.pb.h"
#include "wire/convert.h"

namespace vsplit::wire {
namespace pb = google::protobuf;

namespace {

/// Told by name: a descriptor may be of another pool than the generated code's.
bool is_of(const pb::EnumValueDescriptor& value, const pb::EnumDescriptor& type) {
    return value.type()->full_name() == type.full_name();
}

std::string_view engines_name(const pb::EnumValueDescriptor& value) {
    if (is_of(value, *v1::LengthUnit_descriptor())) {
        const Expected<std::optional<LengthUnit>> unit = from_proto(static_cast<v1::LengthUnit>(value.number()));
        if (unit && *unit) return unit_symbol(**unit);
    }
    if (is_of(value, *v1::MeshFormat_descriptor())) {
        const Expected<std::optional<MeshFormat>> format = from_proto(static_cast<v1::MeshFormat>(value.number()));
        if (format && *format) return format_name(**format);
    }
    return {};
}

}  // namespace

std::string folded(std::string_view text) {
    std::string made(text);
    std::transform(made.begin(), made.end(), made.begin(), [](char c) {
        if (c == '_') return '-';
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return made;
}

std::string_view symbol_of(const pb::EnumValueDescriptor& value) {
    const std::string_view name = engines_name(value);
    return name == folded(value.name()) ? std::string_view() : name;
}

const pb::EnumValueDescriptor* find_value(const pb::EnumDescriptor& type, std::string_view text) {
    if (const pb::EnumValueDescriptor* const exact = type.FindValueByName(std::string(text))) return exact;
    const std::string sought = folded(text);
    if (sought.empty()) return nullptr;
    for (int i = 0; i < type.value_count(); ++i) {
        if (folded(type.value(i)->name()) == sought || symbol_of(*type.value(i)) == sought) return type.value(i);
    }
    return nullptr;
}

}  // namespace vsplit::wire
