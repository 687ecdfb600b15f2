#include "io/inp_assembly.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <set>

#include "mesh/coordinate.h"

namespace vsplit {

const InpAssembly::Part* InpAssembly::find_part(const std::string& name) const {
    const auto found = parts_.find(upper_case(name));
    return found == parts_.end() ? nullptr : &found->second;
}

std::optional<std::size_t> InpAssembly::add_instance(const std::string& name) {
    if (!scope_of_.try_emplace(upper_case(name), scopes_.size()).second) return {};
    scopes_.push_back({name, {}, {}});
    return scopes_.size() - 1;
}

std::optional<std::size_t> InpAssembly::find_instance(std::string_view name) const {
    const auto found = scope_of_.find(upper_case(name));
    return found == scope_of_.end() ? std::nullopt : std::optional(found->second);
}

std::string_view InpAssembly::move(std::size_t scope, const std::vector<double>& numbers) {
    if (!std::all_of(numbers.begin(), numbers.end(), is_valid_coordinate)) return "a number is out of range";
    Motion motion;
    motion.shift = {numbers[0], numbers[1], numbers[2]};
    if (numbers.size() > 3) {
        const Vec3 from(numbers[3], numbers[4], numbers[5]);
        const Vec3 axis = Vec3(numbers[6], numbers[7], numbers[8]) - from;
        if (axis.norm() == 0) return "the axis of the rotation begins and ends at one point";
        motion.turn = Eigen::AngleAxisd(numbers[9] * std::numbers::pi / 180, axis.normalized()).toRotationMatrix();
        motion.shift = motion.turn * (motion.shift - from) + from;
    }
    scopes_[scope].motion = motion;
    return {};
}

Vec3 InpAssembly::moved(std::size_t scope, const Vec3& position) const {
    const std::optional<Motion>& motion = scopes_[scope].motion;
    return motion ? Vec3(motion->turn * position + motion->shift) : position;
}

std::int64_t InpAssembly::number(std::size_t scope, std::int64_t id) {
    std::optional<std::int64_t>& first = scopes_[scope].first_number;
    if (!first) {
        first = static_cast<std::int64_t>(in_use_.size()) * kNumbers;
        in_use_.push_back(scope);
    }
    return *first + id;
}

std::string InpAssembly::set_name(std::size_t scope, std::string_view name) const {
    const std::string& instance = scopes_[scope].name;
    return instance.empty() ? std::string(name) : instance + "." + std::string(name);
}

InpAssembly::Reference InpAssembly::resolve(std::size_t scope, std::string_view field) const {
    const std::size_t point = field.find('.');
    if (point == std::string_view::npos || scope_of_.empty()) return {scope, field};
    const std::optional<std::size_t> instance = find_instance(field.substr(0, point));
    return instance ? Reference{*instance, field.substr(point + 1)} : Reference{scope, field};
}

void InpAssembly::shorten_names(std::vector<FaceSet>& sets) const {
    if (instances() != 1) return;
    const std::string prefix = scopes_.back().name + ".";
    std::set<std::string> taken;
    for (const FaceSet& s : sets) taken.insert(upper_case(s.name));
    for (FaceSet& s : sets) {
        const bool of_instance = equals_ignoring_case(std::string_view(s.name).substr(0, prefix.size()), prefix);
        if (of_instance && taken.insert(upper_case(s.name.substr(prefix.size()))).second) s.name.erase(0, prefix.size());
    }
}

std::string InpAssembly::in_words(std::string_view message) const {
    constexpr std::string_view kDigits = "0123456789";
    std::string words;
    while (!message.empty()) {
        const std::size_t from = std::min(message.find_first_of(kDigits), message.size());
        const std::size_t to = std::min(message.find_first_not_of(kDigits, from), message.size());
        const std::string_view digits = message.substr(from, to - from);
        const std::int64_t number = parse_integer(digits).value_or(0);
        const auto scope = static_cast<std::size_t>(number / kNumbers);
        const bool shifted = scope > 0 && scope < in_use_.size();
        words += message.substr(0, from);
        words += shifted ? set_name(in_use_[scope], std::to_string(number % kNumbers)) : std::string(digits);
        message.remove_prefix(to);
    }
    return words;
}

}  // namespace vsplit
