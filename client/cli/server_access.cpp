#include "cli/server_access.h"

#include <cstdlib>
#include <fstream>
#include <string>

namespace vsplit::cli {
namespace {

std::string variable(const char* name) {
    const char* const value = std::getenv(name);
    return value == nullptr ? std::string() : std::string(value);
}

// The first word of the file: what vsplitd --new-token prints may stand there as it is.
Expected<std::string> read_token(const std::string& file) {
    std::ifstream in(file);
    if (!in) return Error{Cause::kFileAccess, "cannot read '" + file + "'", "token_file"};
    std::string token;
    if (!(in >> token)) return Error{Cause::kEmptyInput, "'" + file + "' holds no token", "token_file"};
    return token;
}

}  // namespace

Expected<client::ConnectOptions> connect_options(const Arguments& arguments, const std::stop_token& stop) {
    client::ConnectOptions options;
    options.stop = stop;
    options.tls = {arguments.tls_ca, arguments.tls_cert, arguments.tls_key};
    options.traceparent = variable("TRACEPARENT");
    if (arguments.token_file.empty()) {
        options.token = variable("VSPLIT_TOKEN");
        return options;
    }
    Expected<std::string> token = read_token(arguments.token_file);
    if (!token) return token.error();
    options.token = *std::move(token);
    return options;
}

}  // namespace vsplit::cli
