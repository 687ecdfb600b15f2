#include "vsplit/io/mesh_format.h"

#include <algorithm>
#include <array>
#include <string>

#include "io/text_lines.h"

namespace vsplit {
namespace {

struct FormatName {
    std::string_view name;
    MeshFormat format;
    std::string_view extension;  // empty where another format has it
};

constexpr std::array<FormatName, 16> kFormats = {{{"stl", MeshFormat::kStlBinary, ".stl"},
                                                  {"stl-ascii", MeshFormat::kStlAscii, ""},
                                                  {"obj", MeshFormat::kObj, ".obj"},
                                                  {"ply", MeshFormat::kPlyBinary, ".ply"},
                                                  {"ply-ascii", MeshFormat::kPlyAscii, ""},
                                                  {"off", MeshFormat::kOff, ".off"},
                                                  {"msh", MeshFormat::kMsh, ".msh"},
                                                  {"msh-ascii", MeshFormat::kMshAscii, ""},
                                                  {"msh2", MeshFormat::kMsh2, ""},
                                                  {"msh2-ascii", MeshFormat::kMsh2Ascii, ""},
                                                  {"inp", MeshFormat::kInp, ".inp"},
                                                  {"bdf", MeshFormat::kBdf, ".bdf"},
                                                  {"vtk", MeshFormat::kVtk, ".vtk"},
                                                  {"vtk-ascii", MeshFormat::kVtkAscii, ""},
                                                  {"vtu", MeshFormat::kVtu, ".vtu"},
                                                  {"3mf", MeshFormat::k3mf, ".3mf"}}};

/// "a, b, c".
std::string list_of(std::string_view FormatName::*column) {
    std::string list;
    for (const FormatName& format : kFormats) {
        if (!(format.*column).empty()) list.append(list.empty() ? "" : ", ").append(format.*column);
    }
    return list;
}

}  // namespace

std::span<const MeshFormat> mesh_formats() {
    static const auto all = [] {
        std::array<MeshFormat, kFormats.size()> formats{};
        std::transform(kFormats.begin(), kFormats.end(), formats.begin(), [](const FormatName& known) { return known.format; });
        return formats;
    }();
    return all;
}

std::string_view format_name(MeshFormat format) {
    for (const FormatName& known : kFormats) {
        if (known.format == format) return known.name;
    }
    return {};
}

Expected<MeshFormat> format_by_name(std::string_view name) {
    for (const FormatName& known : kFormats) {
        if (known.name == name) return known.format;
    }
    return Error{Cause::kInvalidOption,
                 "no mesh format is called '" + std::string(name) + "'; known are " + list_of(&FormatName::name), "format"};
}

Expected<MeshFormat> format_by_extension(std::string_view file_name) {
    const std::size_t slash = file_name.find_last_of('/');
    const std::string_view name = slash == std::string_view::npos ? file_name : file_name.substr(slash + 1);
    const std::size_t dot = name.find_last_of('.');
    const std::string_view extension = dot == std::string_view::npos ? std::string_view() : name.substr(dot);
    if (equals_ignoring_case(extension, ".nas")) return MeshFormat::kBdf;
    for (const FormatName& known : kFormats) {
        if (!extension.empty() && equals_ignoring_case(known.extension, extension)) return known.format;
    }
    return Error{Cause::kUnknownFormat,
                 "the name '" + std::string(name) + "' does not tell a mesh format; known extensions are " +
                     list_of(&FormatName::extension),
                 ""};
}

}  // namespace vsplit
