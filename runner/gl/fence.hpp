// Tests whether the driver has finished all commands up to a point.
#pragma once

#include <GL/glcorearb.h>

#include <memory>

namespace tidemark::gl {

class Fence {
public:
    /// Inserts a fence after the commands issued so far and flushes them.
    Fence();

    /// Waits up to that many seconds; returns whether the commands are finished. 0 only tests.
    bool wait(double seconds) const;

private:
    struct Delete {
        void operator()(GLsync sync) const { glDeleteSync(sync); }
    };
    std::unique_ptr<__GLsync, Delete> sync_;
};

} // namespace tidemark::gl
