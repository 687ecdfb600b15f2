#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "guard/tls_files.h"
#include "guard/token_file.h"
#include "guard/watched_files.h"
#include "vsplit/base/expected.h"

namespace vsplit::guard {

/// The tokens of a file, which is read again when it changes, at most once a second. Thread-safe.
class TokenBook {
public:
    /// \return what parse_token_file returns, FILE_ACCESS.
    [[nodiscard]] static Expected<std::unique_ptr<TokenBook>> open(const std::string& file, ReloadObserver observer);

    struct Holder {
        std::string name;
        Access access = Access::kRead;
    };

    /// Who has this token. Compares with every token of the book, in a time that tells nothing of any. O(tokens).
    [[nodiscard]] std::optional<Holder> find(std::string_view token);

private:
    using Tokens = std::vector<Token>;

    TokenBook(std::string file, Tokens tokens, ReloadObserver observer);

    [[nodiscard]] static Expected<Tokens> read(const std::string& file);
    [[nodiscard]] std::shared_ptr<const Tokens> current();

    const std::string file_;
    const ReloadObserver observer_;
    std::mutex mutex_;
    WatchedFiles watched_;
    std::shared_ptr<const Tokens> tokens_;
};

}  // namespace vsplit::guard
