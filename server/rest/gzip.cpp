#include "rest/gzip.h"

#include <zlib.h>

#include <array>
#include <new>

namespace vsplit::rest {

struct Gzip::Stream : z_stream {};

Gzip::Gzip() : stream_(std::make_unique<Stream>()) {
    constexpr int kGzipWindow = 15 + 16;  // zlib's largest window, with gzip's header instead of zlib's
    constexpr int kMemory = 8;
    if (deflateInit2(stream_.get(), Z_BEST_SPEED, Z_DEFLATED, kGzipWindow, kMemory, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::bad_alloc();
}

Gzip::~Gzip() { deflateEnd(stream_.get()); }

std::string Gzip::take(std::string_view part, bool last) {
    std::string made;
    std::array<unsigned char, 16384> room;  // NOLINT(cppcoreguidelines-pro-type-member-init): zlib fills it
    // zlib reads through a pointer to what is not const, and changes nothing.
    stream_->next_in = const_cast<unsigned char*>(reinterpret_cast<const unsigned char*>(part.data()));
    stream_->avail_in = static_cast<unsigned>(part.size());
    const int mode = last ? Z_FINISH : Z_NO_FLUSH;
    do {
        stream_->next_out = room.data();
        stream_->avail_out = room.size();
        deflate(stream_.get(), mode);
        made.append(reinterpret_cast<const char*>(room.data()), room.size() - stream_->avail_out);
    } while (stream_->avail_out == 0);
    return made;
}

}  // namespace vsplit::rest
