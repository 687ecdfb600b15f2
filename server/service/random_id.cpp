#include "service/random_id.h"

#include <sys/random.h>

#include <array>
#include <cerrno>

namespace vsplit::service {

Expected<std::string> random_id() {
    std::array<unsigned char, 16> bytes{};
    // Up to 256 bytes come whole or not at all, except when a signal arrives before the generator is seeded.
    while (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
        if (errno != EINTR) return Error{Cause::kInternal, "the operating system gave no random bytes for a session id", ""};
    }
    static constexpr char kDigits[] = "0123456789abcdef";
    std::string id;
    for (const unsigned char byte : bytes) {
        id += kDigits[byte >> 4U];
        id += kDigits[byte & 15U];
    }
    return id;
}

}  // namespace vsplit::service
