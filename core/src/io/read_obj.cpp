#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "io/group_runs.h"
#include "io/mesh_builder.h"
#include "io/obj_keyword.h"
#include "io/read_error.h"
#include "io/readers.h"
#include "io/text_lines.h"

namespace vsplit {
namespace {

/// Reads the `v`, `f` and `g` lines of an OBJ; other lines that it may have are passed over by name.
class ObjText {
public:
    ObjText(std::string_view text, std::uint32_t max_faces) : lines_(text), builder_(max_faces) {}

    Expected<TriangleMesh> read() {
        while (next_line()) {
            if (const Status status = read_line(); !status) return status.error();
        }
        if (const Status status = check_forward_references(); !status) return status.error();
        Expected<TriangleMesh> mesh = builder_.take();
        if (mesh) groups_.give_to(*mesh, GroupRuns::Lone::kIsGroup);
        return mesh;
    }

private:
    /// A face that names a vertex which the file has not given yet.
    struct ForwardReference {
        std::size_t line = 0;
        std::uint64_t vertex = 0;  // from 1
    };

    /// Goes to the next line, which a backslash at its end continues. `line_` is its text, `number_` where it begins.
    bool next_line() {
        if (!lines_.next()) return false;
        line_ = lines_.line();
        number_ = lines_.number();
        if (!line_.ends_with('\\')) return true;
        joined_.clear();
        while (line_.ends_with('\\')) {
            joined_.append(line_, 0, line_.size() - 1).append(" ");
            line_ = lines_.next() ? lines_.line() : std::string_view();
        }
        line_ = joined_.append(line_);
        return true;
    }

    Status read_line() {
        const std::string_view keyword = next_word(line_);
        if (keyword.empty() || keyword.front() == '#') return Done{};
        const std::optional<ObjLine> line = obj_line(keyword);
        if (!line) return malformed("expected a keyword such as 'v' or 'f', " + found(keyword));
        switch (*line) {
            case ObjLine::kVertex:
                return read_vertex();
            case ObjLine::kFace:
                return read_face();
            case ObjLine::kGroup:
                return begin_groups();
            case ObjLine::kPassedOver:
                return Done{};
            case ObjLine::kNotRead:
                break;
        }
        return read_error(Cause::kUnsupported, at_line(number_),
                          quoted(keyword) + " is not read; faces ('f') are: convert free-form surfaces and other files to them");
    }

    /// The faces that follow are in each of the groups that are named.
    Status begin_groups() {
        std::vector<std::string_view> names;
        for (std::string_view name = next_word(line_); !name.empty() && name.front() != '#'; name = next_word(line_))
            names.push_back(name);
        groups_.begin(names, builder_.face_count());
        return Done{};
    }

    Status read_vertex() {
        Vec3 position;
        for (int axis = 0; axis < 3; ++axis) {
            const std::string_view word = next_word(line_);
            const std::optional<double> value = parse_number(word);
            if (!value)
                return malformed("expected 3 coordinates of a vertex, " + found(word) + " for number " +
                                 std::to_string(axis + 1));
            position[axis] = *value;
        }
        return builder_.add_vertex(position, at_line(number_));
    }

    Status read_face() {
        corners_.clear();
        for (std::string_view word = next_word(line_); !word.empty() && word.front() != '#'; word = next_word(line_)) {
            const Expected<std::uint32_t> vertex = read_corner(word);
            if (!vertex) return vertex.error();
            corners_.push_back(*vertex);
        }
        return builder_.add_polygon(corners_, at_line(number_));
    }

    /// The vertex (from 0) of `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from the first or, if negative, back from the last.
    Expected<std::uint32_t> read_corner(std::string_view word) {
        const std::size_t slash = std::min(word.find('/'), word.size());
        const std::optional<std::int64_t> index = parse_integer(word.substr(0, slash));
        if (!index || word.find_first_not_of("0123456789/-", slash) != std::string_view::npos) {
            return malformed("expected a corner such as '1', '1/2', '1//3' or '1/2/3', " + found(word)).error();
        }
        const std::int64_t count = builder_.vertex_count();
        if (*index == 0 || *index < -count || *index > static_cast<std::int64_t>(kMaxVertices)) {
            return read_error(Cause::kIndexOutOfRange, at_line(number_),
                              "a face names vertex " + std::to_string(*index) + " where " + std::to_string(count) +
                                  " are given; indices count from 1, or from -1 backwards");
        }
        if (*index > count) note_forward_reference(static_cast<std::uint64_t>(*index));
        return static_cast<std::uint32_t>(*index > 0 ? *index - 1 : *index + count);
    }

    /// Only one that goes further than all before it can be the first that goes too far.
    void note_forward_reference(std::uint64_t vertex) {
        if (forward_.empty() || forward_.back().vertex < vertex) forward_.push_back({number_, vertex});
    }

    [[nodiscard]] Status check_forward_references() const {
        for (const ForwardReference& reference : forward_) {
            if (reference.vertex <= builder_.vertex_count()) continue;
            return read_error(Cause::kIndexOutOfRange, at_line(reference.line),
                              "a face names vertex " + std::to_string(reference.vertex) + ", but the file has " +
                                  std::to_string(builder_.vertex_count()));
        }
        return Done{};
    }

    [[nodiscard]] Status malformed(std::string_view what) const {
        return read_error(Cause::kMalformedInput, at_line(number_), what);
    }

    TextLines lines_;
    std::string_view line_;
    std::size_t number_ = 0;
    std::string joined_;  // a continued line
    std::vector<std::uint32_t> corners_;
    std::vector<ForwardReference> forward_;
    GroupRuns groups_;
    MeshBuilder builder_;
};

}  // namespace

Expected<TriangleMesh> read_obj(std::span<const std::byte> bytes, std::uint32_t max_faces) {
    return ObjText(without_mark(as_text(bytes)), max_faces).read();
}

}  // namespace vsplit
