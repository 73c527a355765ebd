// Finds and loads the picture plug-in. Once loaded it stays until the process ends.
#pragma once

#include "base/result.hpp"
#include "image/plugin/picture_codec.hpp"

#include <filesystem>
#include <vector>

namespace tidemark::image {

/// The plug-in in the first of the `folders` that has one, else the one that the system's loader finds by
/// its name alone (RUNPATH, LD_LIBRARY_PATH). ErrorCode::load says where it was looked for and what to do.
Result<const PictureCodec*> load_picture_codec(const std::filesystem::path& file_name,
                                               const std::vector<std::filesystem::path>& folders);

/// The plug-in of this program: beside it, or in ../lib/tidemark from there (as installed), or where the
/// system's loader looks. Loaded by the first call; others wait for it. A failure is kept.
const Result<const PictureCodec*>& picture_codec();

} // namespace tidemark::image
