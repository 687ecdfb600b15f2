#include "cli/file_hash.h"

#include <openssl/evp.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <memory>
#include <new>
#include <system_error>

namespace vsplit::cli {

Expected<SourceHash> hash_of_file(const std::string& path) {
    const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
    if (!context || EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) != 1) throw std::bad_alloc();
    std::ifstream file(path, std::ios::binary);
    std::array<char, 65536> part{};
    while (file) {
        file.read(part.data(), part.size());
        EVP_DigestUpdate(context.get(), part.data(), static_cast<std::size_t>(file.gcount()));
    }
    if (!file.eof()) {
        return Error{Cause::kFileAccess, "cannot read '" + path + "': " + std::generic_category().message(errno), "input"};
    }
    SourceHash hash{};
    EVP_DigestFinal_ex(context.get(), hash.data(), nullptr);
    return hash;
}

}  // namespace vsplit::cli
