#include "cli/interrupt.hpp"

#include "base/leftovers.hpp"

namespace tidemark::cli {

Interrupt::Interrupt() {
    sigemptyset(&signals_);
    for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) // SIGUSR1 wakes the listener so that it can end
        sigaddset(&signals_, signal);
    struct sigaction hang_up {};
    sigaction(SIGHUP, nullptr, &hang_up);
    if (hang_up.sa_handler != SIG_IGN) // ignored for example under nohup
        sigaddset(&signals_, SIGHUP);
    pthread_sigmask(SIG_BLOCK, &signals_, &previous_mask_);
    // Wait until the listener runs: a fork while a thread is starting could copy a lock that is never
    // released, and the child would wait for it.
    listener_ = std::thread([this] {
        started_.count_down();
        int signal = 0;
        while (sigwait(&signals_, &signal) == 0) {
            if (ending_)
                return;
            // When a terminal closes, the kernel and the shell both send SIGHUP: count that as one request.
            if (signal != SIGUSR1 && ((requested_.exchange(true) && signal != SIGHUP) || immediate_))
                exit_at_once(k_exit_code);
            const std::lock_guard lock(mutex_);
            if (wake_)
                wake_();
        }
    });
    started_.wait();
}

void Interrupt::wake_by(std::function<void()> wake) {
    const std::lock_guard lock(mutex_);
    wake_ = std::move(wake);
}

Interrupt::~Interrupt() {
    ending_ = true;
    pthread_kill(listener_.native_handle(), SIGUSR1);
    listener_.join();
    pthread_sigmask(SIG_SETMASK, &previous_mask_, nullptr);
}

} // namespace tidemark::cli
