// What the driver's compiler says of its own accord, while this lives (GL_KHR_debug). Some drivers tell how
// large a shader became; others say nothing, and a context that was not made for debugging may be silent,
// too.
#pragma once

#include <string>
#include <vector>

namespace tidemark::gl {

/// Of the context that is current when it is made, whose debug output it takes over; it stays where it is.
class CompilerMessages {
public:
    CompilerMessages();
    ~CompilerMessages();
    CompilerMessages(const CompilerMessages&) = delete;
    CompilerMessages& operator=(const CompilerMessages&) = delete;

    /// Those since the last call.
    std::vector<std::string> take();

private:
    std::vector<std::string> messages_;
};

} // namespace tidemark::gl
