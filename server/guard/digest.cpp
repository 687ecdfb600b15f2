#include "guard/digest.h"

#include <openssl/evp.h>

#include <memory>
#include <new>

namespace vsplit::guard {

Digest digest_of(std::string_view bytes) {
    const std::span<const std::byte> part = std::as_bytes(std::span(bytes));
    return digest_of({&part, 1});
}

Digest digest_of(std::span<const std::span<const std::byte>> parts) {
    const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
    if (!context || EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) != 1) throw std::bad_alloc();
    for (const std::span<const std::byte> part : parts) EVP_DigestUpdate(context.get(), part.data(), part.size());
    Digest digest{};
    EVP_DigestFinal_ex(context.get(), digest.data(), nullptr);
    return digest;
}

std::string hex_digits(const Digest& digest) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string text;
    for (const unsigned char byte : digest) {
        text += kDigits[byte >> 4U];
        text += kDigits[byte & 15U];
    }
    return text;
}

}  // namespace vsplit::guard
