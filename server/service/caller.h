#pragma once

#include <string>

namespace vsplit::service {

/// On whose behalf something is done. Sessions belong to the owner that made them; for any other they are not there.
struct Caller {
    std::string owner{};       ///< name of a token; empty where the server takes calls without: all of those are one owner
    std::string request_id{};  ///< of the call, for the log
};

}  // namespace vsplit::service
