#include "service/thread_priority.h"

#if defined(__linux__)
#include <sys/resource.h>
#endif

namespace vsplit::service {

void set_priority(ThreadPriority priority) {
#if defined(__linux__)
    constexpr int kNicer = 5;  // a third of the share of those that have the usual one
    constexpr int kThisThread = 0;
    if (priority == ThreadPriority::kUsual) return;
    static_cast<void>(setpriority(PRIO_PROCESS, kThisThread, getpriority(PRIO_PROCESS, kThisThread) + kNicer));
#else
    static_cast<void>(priority);
#endif
}

}  // namespace vsplit::service
