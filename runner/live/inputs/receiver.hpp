// A thread that reads packets from a descriptor (a socket, a pipe, a device) and puts them into an Inbox.
#pragma once

#include "base/descriptor.hpp"
#include "live/inputs/inbox.hpp"

#include <thread>

namespace tidemark::live {

class Receiver {
public:
    /// Takes ownership of the descriptor. Each read is one packet. The thread ends at the end of the input.
    Receiver(int from, Inbox& into);
    ~Receiver();
    Receiver(const Receiver&) = delete;
    Receiver& operator=(const Receiver&) = delete;

private:
    void receive(Inbox& into) const;

    Descriptor from_;
    Descriptor stop_; ///< an eventfd that becomes readable when the thread must end
    std::thread thread_;
};

} // namespace tidemark::live
