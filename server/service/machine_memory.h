#pragma once

#include <cstdint>
#include <filesystem>

namespace vsplit::service {

/// Bytes that the process's control group and those around it allow, of either version; the largest number where none limits it.
/// \param groups where control groups are mounted, /sys/fs/cgroup
/// \param membership what the kernel says of the process's groups, /proc/self/cgroup
[[nodiscard]] std::uint64_t control_group_memory(const std::filesystem::path& groups, const std::filesystem::path& membership);

/// Three quarters of the memory that the machine, or the container, has.
[[nodiscard]] std::uint64_t usual_memory_limit();

}  // namespace vsplit::service
