#pragma once

namespace vsplit::service {

/// Who goes first where there are more threads than cores.
enum class ThreadPriority {
    kUsual,       ///< speaks to clients, or waits for a disk
    kBackground,  ///< computes: whoever waits for an answer that needs no computing does not wait for it
};

/// Of the calling thread and of those that it starts. Linux' nice values are a thread's own; elsewhere nothing changes.
void set_priority(ThreadPriority priority);

}  // namespace vsplit::service
