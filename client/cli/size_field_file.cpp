#include "cli/size_field_file.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <utility>

namespace vsplit::cli {
namespace {

Error cannot_read(const std::string& path) {
    const int reason = errno;
    return {reason == ENOENT ? Cause::kNotFound : Cause::kFileAccess,
            "cannot read the size field '" + path + "': " + std::strerror(reason), "size_field"};
}

constexpr const char* kBlanks = " \t\r";

std::string trimmed(const std::string& line) {
    const std::size_t first = line.find_first_not_of(kBlanks);
    return first == std::string::npos ? "" : line.substr(first, line.find_last_not_of(kBlanks) + 1 - first);
}

}  // namespace

Expected<std::vector<double>> read_size_field(const std::string& path) {
    errno = 0;
    std::ifstream file(path);
    if (!file) return cannot_read(path);
    std::vector<double> sizes;
    std::string line;
    for (std::size_t number = 1; std::getline(file, line); ++number) {
        const std::string word = trimmed(line);
        if (word.empty()) continue;
        char* end = nullptr;
        sizes.push_back(std::strtod(word.c_str(), &end));
        if (end == word.c_str() + word.size()) continue;
        return Error{Cause::kMalformedInput,
                     "line " + std::to_string(number) + " of '" + path + "' is '" + word.substr(0, 64) +
                         "'; accepted is one number a line",
                     "size_field"};
    }
    if (file.bad()) return cannot_read(path);
    if (!sizes.empty()) return sizes;
    return Error{Cause::kEmptyInput, "'" + path + "' holds no number; accepted is one a line, for each vertex", "size_field"};
}

Status read_size_field_into(Arguments& arguments) {
    if (arguments.size_field.empty()) return Done{};
    Expected<std::vector<double>> sizes = read_size_field(arguments.size_field);
    if (!sizes) return sizes.error();
    std::optional<SizingOptions>& sizing = arguments.verb == Verb::kControl ? arguments.control.sizing : arguments.improve.sizing;
    if (!sizing) sizing.emplace();
    sizing->field = *std::move(sizes);
    return Done{};
}

}  // namespace vsplit::cli
