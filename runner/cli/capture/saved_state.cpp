#include "cli/capture/saved_state.hpp"

#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/try.hpp"
#include "cli/json_dump.hpp"
#include "cli/sequence.hpp"

#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <map>

namespace tidemark::cli {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view k_ending = ".state";
constexpr int k_version_of_format = 1;
constexpr size_t k_checksum = 64;
constexpr uint64_t k_most_floats = uint64_t{1} << 40; ///< larger than any disk
constexpr size_t k_longest_header = size_t{1} << 20;  ///< bytes

std::span<const std::byte> bytes_of(std::string_view text) {
    return std::as_bytes(std::span(text));
}

/// Returns the header, one line. The textures follow it, then the checksum of everything before.
std::string header_of(const SavedState& state, const Fingerprint& fingerprint) {
    Json passes = Json::array();
    for (const render::PassState& pass : state.buffers) {
        Json& sizes = passes.emplace_back(Json::array({pass.pass, Json::array()}))[1];
        for (const render::TextureFloats& texture : pass.textures)
            sizes.push_back(texture.size());
    }
    return dump(Json{{"tidemark_state", k_version_of_format},
                     {"fingerprint", fingerprint.text()},
                     {"frame", state.frame},
                     {"program", int(state.program)},
                     {"passes", passes}}) +
           "\n";
}

/// Takes floats from the front of `rest`; returns false if there are too few.
bool take(std::string_view& rest, size_t count, render::TextureFloats& texture) {
    if (count > rest.size() / sizeof(float))
        return false;
    texture.resize(count);
    std::memcpy(texture.data(), rest.data(), count * sizeof(float));
    rest.remove_prefix(count * sizeof(float));
    return true;
}

/// Returns the size of the whole file in bytes, according to its header. Throws for an unknown header.
uint64_t size_of(const Json& header, uint64_t header_bytes) {
    uint64_t floats = 0;
    for (const Json& pass : header.at("passes"))
        for (const Json& count : pass.at(1))
            floats += std::min(count.get<uint64_t>(), k_most_floats);
    return header_bytes + std::min(floats, k_most_floats) * sizeof(float) + k_checksum;
}

/// Throws for an unknown header.
std::optional<SavedState> parse(const Json& header, std::string_view rest) {
    const auto program = header.at("program").get<unsigned char>();
    if (program > static_cast<unsigned char>(glsl::Specialise::constants))
        return std::nullopt;
    SavedState state{header.at("frame").get<int>(), glsl::Specialise(program)};
    for (const Json& pass : header.at("passes")) {
        state.buffers.push_back({pass.at(0).get<std::string>(), {}});
        render::PassState& into = state.buffers.back();
        for (const Json& floats : pass.at(1))
            if (!take(rest, floats.get<size_t>(), into.textures.emplace_back()))
                return std::nullopt;
    }
    return state;
}

/// Checks that the last 64 bytes are the checksum of all others, and returns those; nothing if it does not
/// match.
std::optional<std::string_view> without_checksum(std::string_view file) {
    if (file.size() < k_checksum)
        return std::nullopt;
    const std::string_view content = file.substr(0, file.size() - k_checksum);
    return file.substr(content.size()) == sha256(bytes_of(content)) ? std::optional(content) : std::nullopt;
}

} // namespace

OutputPath state_file(const OutputName& output, int frame) {
    return output.of_frame(frame).beside(k_ending);
}

std::vector<fs::path> find_states(const OutputName& output) {
    std::multimap<int, fs::path, std::greater<>> found;
    const fs::path folder = output.of_frame(0).path().parent_path();
    std::error_code ignored;
    for (fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, ignored), end;
         !ignored && entry != end; entry.increment(ignored)) {
        const fs::path& file = entry->path();
        if (file.extension() != k_ending || !fs::is_regular_file(entry->symlink_status(ignored)))
            continue;
        const fs::path picture = fs::path(file).replace_extension();
        // One file for all frames, or that of frame 0.
        if (output.of_frame(0).path().filename() == picture.filename())
            found.emplace(0, file);
        else if (const auto frame = frame_of(picture, output))
            found.emplace(*frame, file);
    }
    std::vector<fs::path> files;
    for (const auto& [frame, file] : found)
        files.push_back(file);
    return files;
}

void remove_states(const OutputName& output) {
    std::error_code ignored;
    for (const fs::path& file : find_states(output))
        fs::remove(file, ignored);
}

Result<void> write_state(const OutputPath& file, const SavedState& state, const Fingerprint& fingerprint) {
    auto staged = TRY(StagedFile::create(file));
    Sha256 hash;
    const auto add = [&](std::span<const std::byte> bytes) {
        hash.add(bytes);
        return staged.write(bytes);
    };
    TRY(add(bytes_of(header_of(state, fingerprint))));
    for (const render::PassState& pass : state.buffers)
        for (const render::TextureFloats& texture : pass.textures)
            TRY(add(std::as_bytes(std::span(texture))));
    TRY(staged.write(bytes_of(hash.digits())));
    if (!state.buffers.empty())
        ::fsync(staged.descriptor()); // the previous state is removed next
    return staged.commit();
}

std::optional<SavedState> read_state(const fs::path& file,
                                     const std::function<Fingerprint(int frame)>& fingerprint_of,
                                     uint64_t most_bytes) {
    try {
        std::string line(k_longest_header, '\0');
        if (!std::ifstream(file, std::ios::binary).getline(line.data(), std::streamsize(line.size())))
            return std::nullopt;
        line.resize(std::strlen(line.c_str()));
        const Json header = parse_json(line);
        const auto size = size_of(header, line.size() + 1);
        if (header.at("tidemark_state") != k_version_of_format ||
            header.at("fingerprint") != fingerprint_of(header.at("frame").get<int>()).text() ||
            size > most_bytes || size != fs::file_size(file))
            return std::nullopt;
        const auto bytes = read_file(file, size);
        const auto content = bytes ? without_checksum(*bytes) : std::nullopt;
        return content && content->starts_with(line) ? parse(header, content->substr(line.size() + 1))
                                                     : std::nullopt;
    } catch (const Json::exception&) { // another program's file
        return std::nullopt;
    } catch (const fs::filesystem_error&) { // the file was removed
        return std::nullopt;
    }
}

} // namespace tidemark::cli
