#include "ops/new_token.h"

#include "guard/token_file.h"
#include "service/random_id.h"

namespace vsplit::ops {

Expected<NewToken> make_token(std::string_view request) {
    const std::size_t colon = request.rfind(':');
    const std::string_view name = request.substr(0, colon);
    const std::string_view access = colon == std::string_view::npos ? std::string_view() : request.substr(colon + 1);
    if (!guard::is_token_name(name) || (access != "read-only" && access != "read-write")) {
        return Error{
            Cause::kInvalidOption,
            "--new-token takes NAME:read-only or NAME:read-write; a name is 1 to 64 of letters, digits, '.', '_' and '-'",
            "new-token"};
    }
    const Expected<std::string> first = service::random_id();
    const Expected<std::string> second = service::random_id();
    if (!first || !second) return (first ? second : first).error();
    NewToken made{"vst_" + *first + *second, {}};
    const guard::Access allowed = access == "read-write" ? guard::Access::kWrite : guard::Access::kRead;
    made.line = guard::token_line({std::string(name), allowed, guard::digest_of(made.token)});
    return made;
}

}  // namespace vsplit::ops
