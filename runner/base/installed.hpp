// Locates the program and the files that come with it, in a build folder or as installed.
#pragma once

#include <filesystem>
#include <string>

namespace tidemark {

/// Returns the folder of the running program, links resolved.
std::filesystem::path program_folder();

/// Returns the folder of the shader library, which `#include <tidemark/…>` reads: shaders/lib in the
/// program's folder, else the installed one (which may not exist).
std::filesystem::path library_folder();

/// Returns why the library is missing and which folders were searched; empty if it is there.
std::string why_no_library();

/// Returns the folder of the projects that test a device's conformance: conformance in the program's folder,
/// else the installed one (which may not exist).
std::filesystem::path conformance_folder();

} // namespace tidemark
