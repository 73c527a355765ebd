// A thread that waits for what arrives at a descriptor (a socket, a pipe, a device) and puts it into an
// Inbox.
#pragma once

#include "base/descriptor.hpp"
#include "live/inputs/inbox.hpp"

#include <thread>

namespace tidemark::live {

class Receiver {
public:
    /// Takes the descriptor over; each read of it is a packet. Ends by itself where there is no more to come.
    Receiver(int from, Inbox& into);
    ~Receiver();
    Receiver(const Receiver&) = delete;
    Receiver& operator=(const Receiver&) = delete;

private:
    void receive(Inbox& into) const;

    Descriptor from_;
    Descriptor stop_; ///< an eventfd: readable once the thread is to end
    std::thread thread_;
};

} // namespace tidemark::live
