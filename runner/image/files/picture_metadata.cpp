#include "image/files/picture_metadata.hpp"

#include "base/file.hpp"
#include "image/files/codec_loader.hpp"
#include "image/files/file_check.hpp"
#include "image/files/picture_file.hpp"
#include "image/files/png_chunks.hpp"

#include <algorithm>
#include <optional>
#include <span>

namespace tidemark::image {
namespace {

constexpr std::string_view k_prefix = "tidemark:";

/// Returns the uncompressed text chunks, which include all of ours.
Metadata texts_of_png(std::string_view file) {
    Metadata texts;
    std::string_view rest = file.substr(k_png_signature);
    while (const auto chunk = take_png_chunk(rest)) {
        const std::string_view data = chunk->data();
        const size_t end = data.find('\0');
        if (chunk->name() == "tEXt" && end != data.npos)
            texts.emplace_back(data.substr(0, end), data.substr(end + 1));
    }
    return texts;
}

void add(Metadata& ours, std::string_view name, std::string_view value) {
    if (name.starts_with(k_prefix))
        ours.emplace_back(name.substr(k_prefix.size()), value);
}

/// Adds lines of the form `tidemark:NAME=VALUE`.
void add_lines(Metadata& ours, std::string_view text) {
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        if (const size_t equals = line.find('='); equals != line.npos)
            add(ours, line.substr(0, equals), line.substr(equals + 1));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
    }
}

/// Finds our names and values, which are separate texts or lines of a description.
Metadata ours_of(const Metadata& texts) {
    Metadata ours;
    for (const auto& [name, value] : texts) {
        add(ours, name, value);
        if (name == "ImageDescription")
            add_lines(ours, value);
    }
    return ours;
}

} // namespace

tl::expected<Metadata, std::string> read_metadata(const std::filesystem::path& path) {
    const auto refuse = [](std::string why) { return tl::unexpected(std::move(why)); };
    const auto file = read_file(path, k_largest_picture);
    if (!file)
        return refuse(file.error().message);
    const std::optional<FileFormat> format = format_of(*file, path);
    if (!format)
        return refuse(file->empty() ? "the file is empty" : "it is no picture");
    if (const auto checked = checked_file(*format, *file); !checked)
        return refuse(checked.error());
    if (*format == FileFormat::png)
        return ours_of(texts_of_png(*file));
    const auto& codec = picture_codec();
    if (!codec)
        return refuse(codec.error().message);
    return (*codec)->texts(*format, std::as_bytes(std::span(*file))).map(ours_of);
}

const std::string* find(const Metadata& metadata, std::string_view name) {
    const auto found = std::ranges::find(metadata, name, &Metadata::value_type::first);
    return found == metadata.end() ? nullptr : &found->second;
}

} // namespace tidemark::image
