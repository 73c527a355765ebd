#include "cli/last_resort.hpp"

#include "base/leftovers.hpp"
#include "cli/console.hpp"

#include <unistd.h>

#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

namespace tidemark::cli {
namespace {

constexpr int k_no_resources = 4;

/// Writes without allocating, as memory may have run out.
void say_at_once(std::string_view line) {
    (void)!::write(STDERR_FILENO, line.data(), line.size());
}

[[noreturn]] void end() {
    if (std::current_exception())
        exit_at_once(last_resort());
    say_at_once(
        "tidemark: error: internal error: a library gave up, as they do where threads or memory run out\n");
    exit_at_once(k_internal_error);
}

} // namespace

void end_by_last_resort() {
    std::set_terminate(end);
}

int last_resort() {
    try {
        throw;
    } catch (const std::bad_alloc&) {
        say_at_once("tidemark: error: out of memory\n");
        return k_no_resources;
    } catch (const std::system_error& error) {
        if (error.code() == std::errc::resource_unavailable_try_again) {
            say_at_once("tidemark: error: cannot start another thread: the system's limit is reached\n");
            return k_no_resources;
        }
        say(std::string("tidemark: error: internal error: ") + error.what());
    } catch (const std::exception& error) {
        say(std::string("tidemark: error: internal error: ") + error.what());
    } catch (...) {
        say_at_once("tidemark: error: internal error: an unknown exception\n");
    }
    return k_internal_error;
}

} // namespace tidemark::cli
