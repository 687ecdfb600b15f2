#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text_lines.h"
#include "vsplit/base/expected.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// The parts of an input deck and where they are placed. A part is its text, read once for each of its instances: with the
/// instance's motion, numbers of its own, and names of sets behind the instance's name. What is of no instance, the model or the
/// assembly, is scope 0.
class InpAssembly {
public:
    struct Part {
        TextLines lines;        ///< the part's first line is the next
        std::size_t bytes = 0;  ///< up to its end
        std::size_t line = 0;   ///< of its *PART
    };

    /// A field that names a set or an element, of an instance ("I.skin", "I.5") or of the scope it stands in.
    struct Reference {
        std::size_t scope = 0;
        std::string_view name;
    };

    void add_part(const std::string& name, const Part& part) { parts_.insert_or_assign(upper_case(name), part); }
    [[nodiscard]] const std::map<std::string, Part>& parts() const { return parts_; }
    [[nodiscard]] const Part* find_part(const std::string& name) const;

    /// A new scope; empty where the name is taken.
    [[nodiscard]] std::optional<std::size_t> add_instance(const std::string& name);
    [[nodiscard]] std::optional<std::size_t> find_instance(std::string_view name) const;
    [[nodiscard]] std::size_t instances() const { return scopes_.size() - 1; }

    /// By a translation and then, with seven numbers more, a turn about the axis from one point to another by an angle in
    /// degrees. \return why not, in words; empty when done.
    [[nodiscard]] std::string_view move(std::size_t scope, const std::vector<double>& numbers);

    [[nodiscard]] Vec3 moved(std::size_t scope, const Vec3& position) const;
    /// A number that no other scope has. Scopes come in the order of their first use, the first has the numbers of the file.
    [[nodiscard]] std::int64_t number(std::size_t scope, std::int64_t id);
    [[nodiscard]] std::string set_name(std::size_t scope, std::string_view name) const;
    [[nodiscard]] Reference resolve(std::size_t scope, std::string_view field) const;

    /// Sets of the only instance lose its name where none else has theirs; of several, all keep it.
    void shorten_names(std::vector<FaceSet>& sets) const;
    /// `message` with the numbers that number() made as the file has them: "I.5".
    [[nodiscard]] std::string in_words(std::string_view message) const;

    /// One more than the largest number of a node or element.
    static constexpr std::int64_t kNumbers = 1'000'000'000'000;

private:
    struct Motion {
        Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
        Vec3 shift = Vec3::Zero();
    };
    struct Scope {
        std::string name;
        std::optional<Motion> motion;
        std::optional<std::int64_t> first_number;
    };

    std::map<std::string, Part> parts_;  // by name in upper case
    std::vector<Scope> scopes_{1};
    std::map<std::string, std::size_t> scope_of_;  // by name in upper case
    std::vector<std::size_t> in_use_;              // scopes that have numbers, in order
};

}  // namespace vsplit
