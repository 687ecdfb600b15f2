#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "vsplit/base/expected.h"

namespace vsplit::store {

using Bytes = std::span<const std::byte>;

/// Bytes that never change, at hand for as long as this is.
class Blob {
public:
    Blob() = default;
    virtual ~Blob() = default;
    Blob(const Blob&) = delete;
    Blob& operator=(const Blob&) = delete;

    [[nodiscard]] virtual Bytes bytes() const = 0;
};

/// A blob's name and size.
struct BlobEntry {
    std::string key;
    std::uint64_t bytes = 0;
};

/// Keeps bytes under a name that follows from them: 64 hexadecimal digits, their SHA-256. Thread-safe.
class BlobStore {
public:
    BlobStore() = default;
    virtual ~BlobStore() = default;
    BlobStore(const BlobStore&) = delete;
    BlobStore& operator=(const BlobStore&) = delete;

    /// Keeps `parts`, one after the other, as one blob; they are there for good when this returns. Bytes that are kept already
    /// cost nothing. \return LIMIT_EXCEEDED (the quota, a full disk), UNAVAILABLE.
    [[nodiscard]] virtual Expected<BlobEntry> put(std::span<const Bytes> parts) = 0;

    /// One of this key and size. \return CORRUPT for bytes that are not there, or no longer those that were kept; UNAVAILABLE.
    /// O(bytes).
    [[nodiscard]] virtual Expected<std::shared_ptr<const Blob>> get(const BlobEntry& blob) const = 0;

    /// The name that `put` would give. O(bytes).
    [[nodiscard]] virtual std::string key_of(std::span<const Bytes> parts) const = 0;

    /// Takes a blob out of the store without deleting it. \return UNAVAILABLE.
    [[nodiscard]] virtual Status put_aside(const std::string& key) = 0;

    /// One that is not there is removed. \return UNAVAILABLE.
    [[nodiscard]] virtual Status remove(const std::string& key) = 0;

    /// All blobs, by key. \return UNAVAILABLE.
    [[nodiscard]] virtual Expected<std::vector<BlobEntry>> list() const = 0;

    /// How many are put aside. O(those).
    [[nodiscard]] virtual std::uint64_t aside() const = 0;

    /// What all blobs take together, bytes. O(1).
    [[nodiscard]] virtual std::uint64_t bytes() const = 0;
};

}  // namespace vsplit::store
