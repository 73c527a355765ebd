// Whether the driver has done all that it was told up to a moment.
#pragma once

#include <GL/glcorearb.h>

#include <memory>

namespace tidemark::gl {

class Fence {
public:
    /// Behind the commands given so far, which the driver begins with at once.
    Fence();

    /// For so long at most; whether they are done. With 0 it only looks.
    bool wait(double seconds) const;

private:
    struct Delete {
        void operator()(GLsync sync) const { glDeleteSync(sync); }
    };
    std::unique_ptr<__GLsync, Delete> sync_;
};

} // namespace tidemark::gl
