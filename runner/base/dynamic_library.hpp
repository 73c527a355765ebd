// Libraries that are loaded on demand: of the system, and the program's own plug-ins.
//
// Loads system libraries that only some runs need. They stay loaded until the process ends. The build needs
// only their headers.
#pragma once

#include "base/error.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark {

class SharedLibrary {
public:
    /// `file` is the loader's name for it: `libasound.so.2`.
    explicit SharedLibrary(const char* file);

    template <class Function>
    SharedLibrary& find(const char* name, Function*& function) {
        function = reinterpret_cast<Function*>(address_of(name));
        return *this;
    }

    /// Checks that the library and all functions were found; otherwise ErrorCode::load says what to install.
    /// `what` describes the library: `libsndfile, which reads sound`.
    Result<void> complete(std::string_view what, std::string_view package) const;

private:
    void* address_of(const char* name);

    void* handle_;
    std::string missing_{}; ///< the loader's message about the first missing thing
};

// Loads the program's own plug-in libraries, which hold code that most runs do not need, on demand. Once
// loaded, one stays until the process ends.

struct PlugIn {
    std::filesystem::path file;   ///< "tidemark_pictures.so"
    std::string_view name;        ///< "picture plug-in"
    std::string_view purpose;     ///< "reading and writing pictures"
    std::string_view requirement; ///< what it is linked with: "OpenImageIO 2.4"
    const char* entry;            ///< the function that returns its table
    unsigned version;             ///< version of that table, which begins with it; another version is refused
};

/// Returns the folders searched first: the program's own, and ../lib/tidemark from there (as installed).
std::vector<std::filesystem::path> plug_in_folders();

/// Returns the table of the plug-in in the first of the `folders` that has it, else of the one that the
/// system's loader finds by name (RUNPATH, LD_LIBRARY_PATH). ErrorCode::load names the places searched and
/// says what to do.
Result<const void*> load_plug_in(const PlugIn& plug_in, const std::vector<std::filesystem::path>& folders);

/// Loads a plug-in of this program and returns its table.
template <class Table>
Result<const Table*> load_plug_in(const PlugIn& plug_in) {
    return load_plug_in(plug_in, plug_in_folders()).map([](const void* table) {
        return static_cast<const Table*>(table);
    });
}

} // namespace tidemark
