#pragma once

#include <thread>
#include <vector>

#include "rest/asio.h"

namespace vsplit::rest {

/// Threads for what is heavy. On Linux those that speak to clients go before them. They call nothing that starts threads, which
/// would be as nice: gRPC, for example.
class Background {
public:
    /// \pre threads > 0.
    explicit Background(unsigned threads);
    Background(const Background&) = delete;
    Background& operator=(const Background&) = delete;

    /// Returns when everything that was begun is done.
    ~Background();

    /// Runs `work` on one of them, so that no connection waits for it, and goes on where the caller was.
    template <class Work>
    Awaitable<decltype(std::declval<Work&>()())> run(Work work) {
        using Result = decltype(work());
        // The coroutine's arguments live in its frame, a lambda's captures would not. Asio wants a result that can be empty.
        constexpr auto kRun = [](Work task) -> Awaitable<std::optional<Result>> { co_return task(); };
        std::optional<Result> result = co_await net::co_spawn(context_, kRun(std::move(work)), net::use_awaitable);
        co_return *std::move(result);
    }

private:
    net::io_context context_;
    net::executor_work_guard<net::io_context::executor_type> work_ = net::make_work_guard(context_);
    std::vector<std::thread> threads_;
};

}  // namespace vsplit::rest
