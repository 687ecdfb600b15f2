#pragma once

// Boost.Asio and Boost.Beast as this folder uses them. <utility> comes first: Boost 1.74's awaitable.hpp needs std::exchange and
// does not include it.
#include <utility>
//
#include <boost/asio/awaitable.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>
#include <boost/system/error_code.hpp>
#include <cstddef>
#include <optional>

/// Coroutines here take and await nothing that g++ 12 gets wrong: no parameter by value that has a destructor (but a shared_ptr),
/// no braced list and no choice by ?: && || within an awaited expression. It would destroy temporaries twice, or never made.
namespace vsplit::rest {

namespace net = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using ErrorCode = boost::system::error_code;

template <class T>
using Awaitable = net::awaitable<T>;

/// For an operation's last argument: awaits it and puts what went wrong into `error` instead of throwing it.
inline auto into(ErrorCode& error) { return net::redirect_error(net::use_awaitable, error); }

/// Bytes that take a thread that speaks to clients no more than a moment, whatever is made of them.
inline constexpr std::size_t kMoment = std::size_t{64} * 1024;

}  // namespace vsplit::rest
