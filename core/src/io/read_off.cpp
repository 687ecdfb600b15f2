#include <optional>
#include <string>
#include <vector>

#include "io/mesh_builder.h"
#include "io/off_header.h"
#include "io/read_error.h"
#include "io/readers.h"
#include "io/text_lines.h"

namespace vsplit {
namespace {

/// Reads an OFF: `OFF`, which may be left out, the counts, a line a vertex, a line a face. What follows a position (normals,
/// colours) or a face's indices (a colour) on its line is skipped.
class OffText {
public:
    OffText(std::string_view text, std::uint32_t max_faces) : lines_(text), builder_(max_faces) {}

    Expected<TriangleMesh> read() {
        for (const auto step : {&OffText::read_keyword, &OffText::read_counts, &OffText::read_vertices, &OffText::read_faces}) {
            if (const Status status = (this->*step)(); !status) return status.error();
        }
        if (next_line()) return malformed("a line follows the last announced face").error();
        return builder_.take();
    }

private:
    bool next_line() {
        if (!lines_.next_content('#')) return false;
        line_ = lines_.line();
        return true;
    }

    Status read_keyword() {
        if (!next_line()) return truncated("'OFF'");
        const std::string_view whole = line_;
        const std::string_view keyword = next_word(line_);
        if (parse_integer(keyword)) {
            line_ = whole;  // the counts
            return Done{};
        }
        if (!is_off_keyword(keyword)) return malformed("expected 'OFF', " + found(keyword));
        std::string_view rest = line_;
        if (next_word(rest) != "BINARY") return Done{};
        return read_error(Cause::kUnsupported, place(), "binary OFF is not read; OFF as text is");
    }

    /// They stand on the keyword's line or the next; the number of edges may be left out.
    Status read_counts() {
        std::string_view rest = line_;
        if (next_word(rest).empty() && !next_line()) return truncated("the counts of vertices and faces");
        const std::string_view counts = line_;
        const std::optional<std::int64_t> vertices = parse_integer(next_word(line_));
        const std::optional<std::int64_t> faces = parse_integer(next_word(line_));
        if (!vertices || !faces || *vertices < 0 || *faces < 0) return unexpected(counts, "the counts of vertices and faces");
        vertices_ = static_cast<std::uint64_t>(*vertices);
        faces_ = static_cast<std::uint64_t>(*faces);

        constexpr std::size_t kLeastVertex = 6;  // "0 0 0" and the line's end, which the last line may lack
        constexpr std::size_t kLeastFace = 8;
        const std::size_t left = lines_.rest().size() + 1;
        if (const Status status = check_announced("vertices", vertices_, kLeastVertex, left, place()); !status)
            return status.error();
        if (const Status status = check_announced("faces", faces_, kLeastFace, left, place()); !status) return status.error();
        return builder_.reserve(vertices_, faces_, place());
    }

    Status read_vertices() {
        for (std::uint64_t vertex = 0; vertex < vertices_; ++vertex) {
            if (!next_line()) return truncated("vertex " + std::to_string(vertex) + " of " + std::to_string(vertices_));
            Vec3 position;
            for (int axis = 0; axis < 3; ++axis) {
                const std::string_view word = next_word(line_);
                const std::optional<double> value = parse_number(word);
                if (!value) return unexpected(word, "a coordinate");
                position[axis] = *value;
            }
            if (const Status status = builder_.add_vertex(position, place()); !status) return status.error();
        }
        return Done{};
    }

    Status read_faces() {
        for (std::uint64_t face = 0; face < faces_; ++face) {
            if (!next_line()) return truncated("face " + std::to_string(face) + " of " + std::to_string(faces_));
            if (const Status status = read_face(); !status) return status.error();
        }
        return Done{};
    }

    Status read_face() {
        const std::string_view word = next_word(line_);
        const std::optional<std::int64_t> count = parse_integer(word);
        if (!count || *count < 0) return unexpected(word, "a face's number of corners");
        corners_.clear();
        for (std::int64_t corner = 0; corner < *count; ++corner) {
            const std::string_view name = next_word(line_);
            const std::optional<std::int64_t> index = parse_integer(name);
            if (!index) return unexpected(name, "corner " + std::to_string(corner) + " of a face");
            if (*index < 0 || static_cast<std::uint64_t>(*index) >= vertices_) return index_error(*index, vertices_, place());
            corners_.push_back(static_cast<std::uint32_t>(*index));
        }
        return builder_.add_polygon(corners_, place());
    }

    [[nodiscard]] Place place() const { return at_line(lines_.number()); }
    [[nodiscard]] Status malformed(std::string_view what) const { return read_error(Cause::kMalformedInput, place(), what); }
    /// `word` stands where `what` should, or the file is cut off there.
    [[nodiscard]] Status unexpected(std::string_view word, const std::string& what) const {
        if (word.empty() && lines_.rest().empty()) return truncated(what);
        return malformed("expected " + what + ", " + found(word));
    }
    [[nodiscard]] Status truncated(std::string_view what) const {
        return read_error(Cause::kTruncatedInput, place(), "the file ends where " + std::string(what) + " should follow");
    }

    TextLines lines_;
    std::string_view line_;
    std::uint64_t vertices_ = 0;
    std::uint64_t faces_ = 0;
    std::vector<std::uint32_t> corners_;
    MeshBuilder builder_;
};

}  // namespace

Expected<TriangleMesh> read_off(std::span<const std::byte> bytes, std::uint32_t max_faces) {
    return OffText(without_mark(as_text(bytes)), max_faces).read();
}

}  // namespace vsplit
