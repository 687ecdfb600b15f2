#include "cli/interrupt.h"

#include <pthread.h>
#include <unistd.h>

#include "cli/app.h"

namespace vsplit::cli {

InterruptWatch::InterruptWatch() {
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGINT);
    sigaddset(&signals_, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &signals_, &blocked_before_);
    thread_ = std::thread([this] { wait(); });
}

InterruptWatch::~InterruptWatch() {
    done_ = true;
    pthread_kill(thread_.native_handle(), SIGINT);  // only wakes the thread: it is blocked everywhere
    thread_.join();
    pthread_sigmask(SIG_SETMASK, &blocked_before_, nullptr);
}

void InterruptWatch::wait() {
    for (;;) {
        int signal = 0;
        if (sigwait(&signals_, &signal) != 0) continue;
        if (done_) return;
        if (!source_.request_stop()) _exit(kExitFailed);
    }
}

}  // namespace vsplit::cli
