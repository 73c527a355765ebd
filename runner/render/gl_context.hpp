// The current OpenGL context: limits, resets, compiler messages.
//
// Reads the names and limits of the current context.
#pragma once

#include "base/error.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::gl {

struct Capabilities {
    std::string vendor;
    std::string renderer;
    std::string version;
    int largest_target = 0;  ///< pixels on a side
    std::string processor{}; ///< CPU vendor, for a software renderer; else empty

    /// Returns what determines rounding: the renderer, for a software renderer the CPU vendor, and whether
    /// it compiles for OpenGL ES.
    std::string device() const {
        return renderer + (processor.empty() ? "" : " on " + processor) +
               (version.starts_with("OpenGL ES") ? " with OpenGL ES" : "");
    }
};

Capabilities query_capabilities();

/// Returns whether the current context is one of OpenGL ES (3.1 or later).
bool is_es();

/// Returns the names of the extensions, each of which a shader sees as a macro.
std::vector<std::string> query_extensions();

/// Returns whether the driver named `renderer` (the value of GL_RENDERER) draws on the CPU.
bool is_software_renderer(std::string_view renderer);

// Detects context resets and exhausted memory after work was given to the driver.

/// Returns why the driver reset the current context, as text; nothing while the context works. After a reset
/// all its objects are lost and read-back pixels are meaningless. A context without reset notification never
/// reports one.
std::optional<std::string_view> reset_reason();

/// Returns whether the current context has reset notification.
bool tells_resets();

/// Fails with ErrorCode::timed_out when the context was reset, and with ErrorCode::no_memory when memory ran
/// out since the last call. `what` completes the phrase "while …".
Result<void> check_work(std::string_view what);

// Collects the messages that the driver's compiler sends through GL_KHR_debug. Some drivers report the size
// of a shader; others send nothing, and a context without the debug flag may send nothing either.

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
