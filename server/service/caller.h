#pragma once

#include <string>

namespace vsplit::service {

/// What the log names a call by.
struct CallMark {
    std::string request_id{};
    std::string trace_id{};  ///< W3C Trace Context; empty where there is none
    std::string span_id{};
};

/// On whose behalf something is done. Sessions belong to the owner that made them; for any other they are not there.
struct Caller {
    std::string owner{};  ///< name of a token; empty where the server takes calls without: all of those are one owner
    CallMark mark{};
};

}  // namespace vsplit::service
