// Collects the messages that the driver's compiler sends through GL_KHR_debug. Some drivers report the size
// of a shader; others send nothing, and a context without the debug flag may send nothing either.
#pragma once

#include <string>
#include <vector>

namespace tidemark::gl {

/// Receives messages of the context that is current at construction, whose debug callback it replaces. Not
/// movable.
class CompilerMessages {
public:
    CompilerMessages();
    ~CompilerMessages();
    CompilerMessages(const CompilerMessages&) = delete;
    CompilerMessages& operator=(const CompilerMessages&) = delete;

    /// Returns the messages since the last call.
    std::vector<std::string> take();

private:
    std::vector<std::string> messages_;
};

} // namespace tidemark::gl
