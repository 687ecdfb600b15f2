#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace vsplit::rest {

/// Makes gzip (RFC 1952) of a stream, quickly rather than small. Memory: 256 KiB of zlib and what one call gives.
class Gzip {
public:
    Gzip();
    ~Gzip();
    Gzip(const Gzip&) = delete;
    Gzip& operator=(const Gzip&) = delete;

    /// The compressed bytes that there are after `part`, and all that are left where `last`
    /// is set. O(part).
    [[nodiscard]] std::string take(std::string_view part, bool last);

private:
    struct Stream;
    std::unique_ptr<Stream> stream_;
};

}  // namespace vsplit::rest
