#include "io/inp_keyword.h"

#include <algorithm>
#include <array>
#include <span>

namespace vsplit {
namespace {

using Names = std::span<const std::string_view>;

bool is_one_of(std::string_view name, Names names) { return std::find(names.begin(), names.end(), name) != names.end(); }

std::string list_of(Names names) {
    std::string list;
    for (const std::string_view name : names) list.append(list.empty() ? "" : ", ").append(name);
    return list;
}

/// In upper case and without blanks: both solvers read "*End Part" and "*ENDPART".
std::string plain(std::string_view text) {
    std::string name = upper_case(text);
    std::erase_if(name, [](char c) { return c == ' ' || c == '\t'; });
    return name;
}

void take_parameters(std::string_view rest, InpKeyword& keyword) {
    while (!trimmed(rest).empty()) {
        std::string_view parameter = next_field(rest, ',');
        std::string key = plain(next_field(parameter, '='));
        std::string_view value = trimmed(parameter);
        if (value.size() > 1 && value.front() == '"' && value.back() == '"') value = value.substr(1, value.size() - 2);
        if (!key.empty()) keyword.parameters.emplace_back(std::move(key), value);
    }
}

/// Parameters begin with a letter, which data rarely do: a comma may also just be left over.
bool is_continuation(std::string_view line) {
    const std::string first = upper_case(line.substr(0, 1));
    return !first.empty() && first[0] >= 'A' && first[0] <= 'Z';
}

/// What the reader makes of a keyword's parameters, or may leave aside.
Names known_parameters(std::string_view keyword) {
    static constexpr std::array<std::string_view, 2> kNode = {"NSET", "SYSTEM"};
    static constexpr std::array<std::string_view, 3> kElement = {"TYPE", "ELSET", "SOLIDELEMENTNUMBERING"};
    static constexpr std::array<std::string_view, 5> kElset = {"ELSET", "GENERATE", "INSTANCE", "INTERNAL", "UNSORTED"};
    static constexpr std::array<std::string_view, 14> kSurface = {
        "NAME",     "TYPE",     "INTERNAL", "COMBINE",  "DEFINITION", "FILLETRADIUS", "LABEL",
        "MAXRATIO", "NOOFFSET", "NOTHICK",  "PROPERTY", "REGIONTYPE", "SCALETHICK",   "TRIM"};
    static constexpr std::array<std::string_view, 2> kInstance = {"NAME", "PART"};
    if (keyword == "*NODE") return kNode;
    if (keyword == "*ELEMENT") return kElement;
    if (keyword == "*ELSET") return kElset;
    if (keyword == "*SURFACE") return kSurface;
    if (keyword == "*INSTANCE") return kInstance;
    return {};
}

/// Those that begin as if they had nodes or elements, and have none.
constexpr std::array<std::string_view, 29> kHarmless = {"*NODEFILE",
                                                        "*NODEPRINT",
                                                        "*NODEOUTPUT",
                                                        "*NODERESPONSE",
                                                        "*NODALENERGYRATE",
                                                        "*NODALTHICKNESS",
                                                        "*NOANALYSIS",
                                                        "*NOCOMPRESSION",
                                                        "*NOTENSION",
                                                        "*NONSTRUCTURALMASS",
                                                        "*NONLINEARBH",
                                                        "*NORMAL",
                                                        "*ELFILE",
                                                        "*ELPRINT",
                                                        "*ELASTIC",
                                                        "*ELECTRICALCONDUCTIVITY",
                                                        "*ELECTRICALRESISTIVITY",
                                                        "*ELECTRICALMATERIAL",
                                                        "*ELECTROMAGNETIC",
                                                        "*ELECTROMAGNETICS",
                                                        "*ELEMENTFILE",
                                                        "*ELEMENTMATRIXOUTPUT",
                                                        "*ELEMENTOPERATOROUTPUT",
                                                        "*ELEMENTOUTPUT",
                                                        "*ELEMENTPROGRESSIVEACTIVATION",
                                                        "*ELEMENTRECOVERYMATRIX",
                                                        "*ELEMENTRESPONSE",
                                                        "*ELEMENTSOLVER",
                                                        "*ELEMENTPRINT"};

}  // namespace

bool InpKeyword::has(std::string_view key) const {
    return std::any_of(parameters.begin(), parameters.end(), [&](const auto& parameter) { return parameter.first == key; });
}

std::string InpKeyword::value(std::string_view key) const {
    const auto found =
        std::find_if(parameters.begin(), parameters.end(), [&](const auto& parameter) { return parameter.first == key; });
    return found == parameters.end() ? std::string() : found->second;
}

InpKeyword take_inp_keyword(TextLines& lines) {
    std::string_view line = trimmed(lines.line());
    InpKeyword keyword;
    bool goes_on = line.ends_with(',');
    keyword.name = plain(next_field(line, ','));
    take_parameters(line, keyword);
    for (TextLines ahead = lines; goes_on && ahead.next();) {
        line = trimmed(ahead.line());
        if (line.starts_with("**")) continue;
        if (!is_continuation(line)) break;
        goes_on = line.ends_with(',');
        take_parameters(line, keyword);
        lines = ahead;
    }
    return keyword;
}

Status check_inp_keyword(const InpKeyword& keyword, Place place) {
    static constexpr std::array<std::string_view, 3> kRead = {"*NODE", "*ELEMENT", "*ELSET"};
    static constexpr std::array<std::string_view, 8> kMakes = {
        "*NGEN", "*NFILL", "*NCOPY", "*NMAP", "*ELGEN", "*ELCOPY", "*SYMMETRICMODELGENERATION", "*IMPORT"};
    const std::string& name = keyword.name;
    const auto unsupported = [&](const std::string& what) { return read_error(Cause::kUnsupported, place, what); };
    if (name == "*INCLUDE") return unsupported("*INCLUDE is not followed; put the mesh into one file");
    if (name == "*SYSTEM") return unsupported("*SYSTEM is not read; give nodes in the global system");
    if (is_one_of(name, kMakes))
        return unsupported(name +
                           " makes or moves nodes or elements and is not followed; write them out under *NODE and *ELEMENT");
    const bool of_mesh = name.starts_with("*NO") || name.starts_with("*EL");
    if (of_mesh && !is_one_of(name, kRead) && !is_one_of(name, kHarmless))
        return unsupported(quoted(name) + " is not known; nodes and elements are read from *NODE, *ELEMENT, *ELSET");
    const Names known = known_parameters(name);
    for (const auto& [key, value] : keyword.parameters) {
        if (!known.empty() && !is_one_of(key, known))
            return unsupported(name + ": the parameter " + quoted(key) + " is not read; accepted are " + list_of(known));
    }
    return Done{};
}

}  // namespace vsplit
