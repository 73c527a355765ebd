// Where the program and what comes with it lie: in a build folder, and as installed.
#pragma once

#include <filesystem>
#include <string>

namespace tidemark {

/// The folder of the program that runs, links followed.
std::filesystem::path program_folder();

/// The shader library, which `#include <tidemark/…>` reads: shaders/lib beside the program, else where it
/// is installed (which need not be there).
std::filesystem::path library_folder();

/// Why there is none, and where it was looked for; empty: there is one.
std::string why_no_library();

/// The projects that a device is held against: conformance beside the program, else where they are installed
/// (which need not be there).
std::filesystem::path conformance_folder();

} // namespace tidemark
