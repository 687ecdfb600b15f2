#include "rest/background.h"

#if defined(__linux__)
#include <sys/resource.h>
#endif

namespace vsplit::rest {
namespace {

// Nice values are a thread's own on Linux.
void be_nice() {
#if defined(__linux__)
    constexpr int kNicer = 5;  // a third of the share of those that have the usual value
    constexpr int kThisThread = 0;
    static_cast<void>(setpriority(PRIO_PROCESS, kThisThread, getpriority(PRIO_PROCESS, kThisThread) + kNicer));
#endif
}

}  // namespace

Background::Background(unsigned threads) {
    for (unsigned i = 0; i < threads; ++i) {
        threads_.emplace_back([this] {
            be_nice();
            context_.run();
        });
    }
}

Background::~Background() {
    work_.reset();
    for (std::thread& thread : threads_) thread.join();
}

}  // namespace vsplit::rest
