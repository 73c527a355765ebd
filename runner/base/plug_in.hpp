// Libraries of our own that hold what most runs do not need: they lie beside the program and are loaded when
// they are needed. Once loaded, one stays until the process ends.
#pragma once

#include "base/result.hpp"

#include <filesystem>
#include <string_view>
#include <vector>

namespace tidemark {

struct PlugIn {
    std::filesystem::path file;   ///< "tidemark_pictures.so"
    std::string_view name;        ///< "picture plug-in"
    std::string_view purpose;     ///< "reading and writing pictures"
    std::string_view requirement; ///< what it is linked with: "OpenImageIO 2.4"
    const char* entry;            ///< the function that gives its table
    unsigned version;             ///< of that table, which begins with it: it refuses one of another build
};

/// Where this program looks first: beside itself, and in ../lib/tidemark from there (as installed).
std::vector<std::filesystem::path> plug_in_folders();

/// The table of the plug-in in the first of the `folders` that has one, else of the one that the system's
/// loader finds by its name alone (RUNPATH, LD_LIBRARY_PATH). ErrorCode::load says where it was looked for
/// and what to do.
Result<const void*> load_plug_in(const PlugIn& plug_in, const std::vector<std::filesystem::path>& folders);

/// The table of a plug-in of this program.
template <class Table>
Result<const Table*> load_plug_in(const PlugIn& plug_in) {
    return load_plug_in(plug_in, plug_in_folders()).map([](const void* table) {
        return static_cast<const Table*>(table);
    });
}

} // namespace tidemark
