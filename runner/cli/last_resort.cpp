#include "cli/last_resort.hpp"

#include <unistd.h>

#include <cstring>
#include <exception>
#include <initializer_list>
#include <new>
#include <system_error>

namespace tidemark::cli {
namespace {

constexpr int k_no_resources = 4;
constexpr int k_internal_error = 70; // EX_SOFTWARE of sysexits.h

/// Without memory of its own: there may be none.
void say_parts(std::initializer_list<const char*> parts) {
    for (const char* part : parts)
        (void)!::write(STDERR_FILENO, part, std::strlen(part));
}

[[noreturn]] void end() {
    if (std::current_exception())
        ::_exit(last_resort());
    say_parts(
        {"tidemark: error: internal error: a library gave up, as they do where threads or memory run out\n"});
    ::_exit(k_internal_error);
}

} // namespace

void end_by_last_resort() {
    std::set_terminate(end);
}

int last_resort() {
    try {
        throw;
    } catch (const std::bad_alloc&) {
        say_parts({"tidemark: error: out of memory\n"});
        return k_no_resources;
    } catch (const std::system_error& error) {
        if (error.code() == std::errc::resource_unavailable_try_again) {
            say_parts({"tidemark: error: cannot start another thread: the system's limit is reached\n"});
            return k_no_resources;
        }
        say_parts({"tidemark: error: internal error: ", error.what(), "\n"});
    } catch (const std::exception& error) {
        say_parts({"tidemark: error: internal error: ", error.what(), "\n"});
    } catch (...) {
        say_parts({"tidemark: error: internal error: an unknown exception\n"});
    }
    return k_internal_error;
}

} // namespace tidemark::cli
