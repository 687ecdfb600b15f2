#include <array>
#include <optional>
#include <string>

#include "io/group_runs.h"
#include "io/mesh_builder.h"
#include "io/read_error.h"
#include "io/readers.h"
#include "io/text_lines.h"
#include "io/vertex_soup.h"

namespace vsplit {
namespace {

/// Reads `solid NAME { facet normal x y z outer loop { vertex x y z } endloop endfacet } endsolid NAME`, any number of them.
/// Words may stand on any line; names end with theirs. Errors are kept: after one, nothing more is read.
class StlText {
public:
    StlText(std::string_view text, std::uint32_t max_faces) : lines_(text), max_faces_(max_faces) {}

    Expected<TriangleMesh> read() {
        while (!error_ && read_solid()) {
        }
        if (error_) return *std::move(error_);
        TriangleMesh mesh = soup_.take();
        solids_.give_to(mesh, GroupRuns::Lone::kIsNone);
        return mesh;
    }

private:
    /// The next word, on this line or a later one; empty at the end of the file.
    std::string_view word() {
        for (;;) {
            const std::string_view found = next_word(rest_);
            if (!found.empty() || !lines_.next()) return found;
            rest_ = lines_.line();
        }
    }

    void fail(Cause cause, std::string_view what) { error_ = read_error(cause, at_line(lines_.number()), what); }

    bool keep(const Status& status) {
        if (!status) error_ = status.error();
        return status.has_value();
    }

    /// Says that `found` stands where `wanted` should.
    void fail_word(std::string_view wanted, std::string_view found) {
        if (found.empty()) {
            fail(Cause::kTruncatedInput, "the file ends where " + std::string(wanted) + " should follow");
        } else {
            fail(Cause::kMalformedInput, "expected " + std::string(wanted) + ", found " + quoted(found));
        }
    }

    bool expect(std::string_view wanted) {
        const std::string_view found = word();
        if (equals_ignoring_case(found, wanted)) return true;
        fail_word("'" + std::string(wanted) + "'", found);
        return false;
    }

    bool read_solid() {
        const std::string_view first = word();
        if (first.empty()) return false;
        if (!equals_ignoring_case(first, "solid")) {
            fail_word("'solid'", first);
            return false;
        }
        const std::string_view name = trimmed(rest_);
        solids_.begin({&name, 1}, static_cast<std::uint32_t>(soup_.face_count()));
        rest_ = {};  // its name
        for (;;) {
            const std::string_view found = word();
            if (equals_ignoring_case(found, "endsolid")) break;
            if (!equals_ignoring_case(found, "facet")) {
                fail_word("'facet' or 'endsolid'", found);
                return false;
            }
            if (!read_facet()) return false;
        }
        rest_ = {};
        return true;
    }

    bool read_facet() {
        if (!expect("normal") || !skip_normal() || !expect("outer") || !expect("loop")) return false;
        std::array<Vec3, 3> corners;
        for (Vec3& corner : corners) {
            if (!expect("vertex") || !read_point(corner)) return false;
        }
        if (!expect("endloop") || !expect("endfacet")) return false;
        if (!keep(check_face_limit(soup_.face_count() + 1, max_faces_, at_line(lines_.number())))) return false;
        soup_.add_triangle(corners[0], corners[1], corners[2]);
        return true;
    }

    /// Writers put NaN of many spellings here where a facet has no area, and nothing is made of it: any three words will do.
    bool skip_normal() {
        for (int axis = 0; axis < 3; ++axis) {
            const std::string_view found = word();
            if (!found.empty() && !equals_ignoring_case(found, "outer")) continue;
            fail_word("a number of the facet's normal", found);
            return false;
        }
        return true;
    }

    bool read_point(Vec3& point) {
        for (int axis = 0; axis < 3; ++axis) {
            const std::string_view found = word();
            const std::optional<double> value = parse_number(found);
            if (!value) {
                fail_word("a coordinate", found);
                return false;
            }
            point[axis] = *value;
        }
        return keep(check_position(point, at_line(lines_.number())));
    }

    TextLines lines_;
    std::string_view rest_;  // of the line
    std::uint32_t max_faces_;
    VertexSoup soup_;
    GroupRuns solids_;
    std::optional<Error> error_;
};

}  // namespace

Expected<TriangleMesh> read_stl_ascii(std::span<const std::byte> bytes, std::uint32_t max_faces) {
    return StlText(without_mark(as_text(bytes)), max_faces).read();
}

}  // namespace vsplit
