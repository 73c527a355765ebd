#include "scene/names.hpp"

#include "base/encoding.hpp"
#include "base/overloaded.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <system_error>

namespace tidemark::scene {
namespace {

using Kind = PassName::Kind;

constexpr int k_letters = 26;

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
}

} // namespace

std::optional<PassName> parse_pass_name(std::string_view name) {
    std::string plain;
    for (const char c : name)
        if (c != ' ' && c != '_' && c != '-')
            plain += lower(c);
    constexpr std::pair<std::string_view, Kind> k_words[] = {
        {"image", Kind::image},     {"common", Kind::common}, {"sound", Kind::sound},
        {"cube", Kind::cubemap},    {"cubea", Kind::cubemap}, {"cubemap", Kind::cubemap},
        {"cubemapa", Kind::cubemap}};
    for (const auto& [word, kind] : k_words)
        if (plain == word)
            return PassName{kind, 0};
    for (const std::string_view word : {"buffer", "buf"})
        if (plain.size() == word.size() + 1 && plain.starts_with(word) && plain.back() >= 'a' &&
            plain.back() <= 'd')
            return PassName{Kind::buffer, plain.back() - 'a'};
    return std::nullopt;
}

std::string buffer_name(int number) {
    return number < k_letters ? fmt::format("Buffer {}", char('A' + number))
                              : fmt::format("Buffer {}", number + 1);
}

std::string to_string(const PassName& name) {
    switch (name.kind) {
    case Kind::common: return "Common";
    case Kind::buffer: return buffer_name(name.number);
    case Kind::cubemap: return "Cube A";
    case Kind::sound: return "Sound";
    case Kind::image: break;
    }
    return "Image";
}

std::string file_name_of(std::string_view pass_name) {
    std::string file;
    for (const char c : pass_name)
        file += c == ' ' ? '_' : lower(c);
    return file + ".glsl";
}

bool is_shader_file(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), lower);
    return extension == ".glsl" || extension == ".frag" || extension == ".fs" || extension == ".txt";
}

namespace fs = std::filesystem;
namespace {

/// Returns the name itself if it has neither `*` nor `{}`. Empty without a complete set of six files.
std::vector<fs::path> cubemap_faces(const fs::path& name) {
    constexpr std::array<std::string_view, 6> k_suffixes[] = {
        {"e", "w", "u", "d", "n", "s"},
        {"east", "west", "up", "down", "north", "south"},
        {"px", "nx", "py", "ny", "pz", "nz"},
        {"posx", "negx", "posy", "negy", "posz", "negz"},
    };
    const std::string text = name.string();
    const size_t braces = text.find("{}");
    const size_t at = braces != std::string::npos ? braces : text.find('*');
    if (at == std::string::npos)
        return {name};
    const size_t length = braces != std::string::npos ? 2 : 1;
    for (const auto& set : k_suffixes) {
        std::vector<fs::path> faces;
        for (const std::string_view suffix : set) {
            fs::path face = std::string(text).replace(at, length, suffix);
            std::error_code ignored;
            if (fs::is_regular_file(face, ignored))
                faces.push_back(std::move(face));
        }
        if (faces.size() == set.size())
            return faces;
    }
    return {};
}

} // namespace

MediaKind media_kind_of(const fs::path& file) {
    constexpr std::pair<std::string_view, MediaKind> k_extensions[] = {
        {".mp3", MediaKind::music},  {".ogg", MediaKind::music}, {".wav", MediaKind::music},
        {".flac", MediaKind::music}, {".mp4", MediaKind::video}, {".webm", MediaKind::video},
        {".ogv", MediaKind::video},  {".gif", MediaKind::video}, {".bin", MediaKind::volume},
    };
    const std::string extension = lower_case(file.extension().string());
    for (const auto& [known, kind] : k_extensions)
        if (extension == known)
            return kind;
    return MediaKind::picture;
}

bool names_a_pass(std::string_view name) {
    return name == "self" || parse_pass_name(name) || is_shader_file(fs::path(name));
}

ChannelInput input_of_name(std::string_view name, const fs::path& folder, PictureAs picture) {
    if (auto generated = generated_input(name))
        return *std::move(generated);
    if (names_a_pass(name))
        return Unbound{};
    fs::path file = (folder / name).lexically_normal();
    switch (media_kind_of(file)) {
    case MediaKind::music: return Music{std::move(file)};
    case MediaKind::video: return Video{std::move(file)};
    case MediaKind::volume: return Volume{std::move(file)};
    case MediaKind::picture:
    case MediaKind::cubemap: break;
    }
    return picture == PictureAs::cubemap ? ChannelInput(Cubemap{{std::move(file)}})
                                         : Picture{std::move(file)};
}

bool find_faces(ChannelInput& input) {
    return std::visit(Overloaded{[](Cubemap& cubemap) {
                                     cubemap.files = cubemap_faces(cubemap.files.front());
                                     return !cubemap.files.empty();
                                 },
                                 [](const auto&) { return true; }},
                      input);
}

namespace {

using enum MediaKind;
constexpr std::nullopt_t no = std::nullopt;

/// Numbers and names before 2017 correspond: tex00 to tex09 are 1 to 10, later ones by date of appearance.
constexpr Media k_media[] = {
    {"RGBA Noise Medium", "f735bee5", "tex16", "30", "Xsf3zn", picture, 256, 256, 4, NoiseKind::rgba_256},
    {"RGBA Noise Small", "3083c722", "tex11", "16", "XdXGzn", picture, 64, 64, 4, NoiseKind::rgba_64},
    {"Gray Noise Medium", "0c7bf5fe", "tex12", "17", "4dXGzn", picture, 256, 256, 1, NoiseKind::grey_256},
    {"Gray Noise Small", "0a405623", "tex10", "15", "4sf3Rn", picture, 64, 64, 1, NoiseKind::grey_64},
    {"Blue Noise", "cb49c003", "", "14854", "XsBSR3", picture, 1024, 1024, 4, NoiseKind::blue_1024},
    {"Bayer", "85a6d686", "tex15", "28", "Xdf3zn", picture, 8, 8, 1, NoiseKind::bayer_8},
    {"RGBA Noise 3D", "aea6b99d", "", "40", "XdX3Rr", volume, 32, 32, 4, NoiseKind::rgba_volume_32},
    {"Grey Noise 3D", "27012b4e", "", "39", "4sfGRr", volume, 32, 32, 1, NoiseKind::grey_volume_32},
    {"Font 1", "08b42b43", "tex21", "49", "4dXGzr", picture, 1024, 1024, 4, no},
    {"Organic 1", "cd4c518b", "tex01", "2", "XsXGRn", picture, 1024, 1024, 4, no},
    {"Organic 2", "92d7758c", "tex09", "10", "XsX3Rn", picture, 1024, 1024, 4, no},
    {"Organic 3", "79520a3d", "tex18", "46", "Xsf3Rr", picture, 1024, 1024, 4, no},
    {"Organic 4", "3871e838", "tex17", "45", "4df3Rr", picture, 1024, 1024, 4, no},
    {"Abstract 1", "52d2a8f5", "tex07", "8", "XdX3Rn", picture, 1024, 1024, 4, no},
    {"Abstract 2", "bd646477", "tex08", "9", "4dX3Rn", picture, 512, 512, 4, no},
    {"Abstract 3", "8979352a", "tex20", "48", "XdXGzr", picture, 1024, 1024, 4, no},
    {"Lichen", "fb918796", "tex06", "7", "4sfGRn", picture, 1024, 1024, 4, no},
    {"Wood", "1f7dca9c", "tex05", "6", "XsfGRn", picture, 1024, 1024, 4, no},
    {"Rusty Metal", "95b90082", "tex02", "3", "4sXGRn", picture, 512, 512, 4, no},
    {"Rock Tiles", "10eb4fe0", "tex00", "1", "4dXGRn", picture, 512, 512, 4, no},
    {"Stars", "e6e5631c", "tex03", "4", "XdfGRn", picture, 512, 512, 4, no},
    {"Pebbles", "ad56fba9", "tex19", "47", "4sf3Rr", picture, 512, 512, 1, no},
    {"London", "8de3a392", "tex04", "5", "4dfGRn", picture, 512, 512, 4, no},
    {"Nyancat", "cbcbb5a6", "tex14", "14", "Xsf3Rn", picture, 256, 32, 4, no},
    {"Uffizi Gallery", "585f9546", "cube00", "22", "", cubemap, 512, 512, 4, no},
    {"Uffizi Gallery Blurred", "793a1056", "cube01", "23", "", cubemap, 64, 64, 4, no},
    {"St. Peter's Basilica", "488bd403", "cube02", "24", "", cubemap, 256, 256, 4, no},
    {"St. Peter's Basilica Blurred", "550a8cce", "cube03", "25", "", cubemap, 64, 64, 4, no},
    {"Forest", "94284d43", "cube04", "26", "", cubemap, 256, 256, 4, no},
    {"Forest Blurred", "0681c014", "cube05", "27", "", cubemap, 64, 64, 4, no},
    {"Google Chrome", "c3a071ec", "vid00", "11", "", video, 480, 360, 4, no},
    {"Britney Spears", "e81e818a", "vid01", "12", "", video, 480, 360, 4, no},
    {"Lustre Creme", "3405e48f", "vid02", "29", "", video, 480, 360, 4, no},
    {"Jean-Claude Van Damme", "35c87bcb", "vid03", "36", "", video, 352, 288, 4, no},
    {"", "3c33c415", "mzk00", "13", "", music, 512, 2, 1, no},
    {"", "29de534e", "mzk01", "18", "", music, 512, 2, 1, no},
    {"", "a6a1cf7a", "mzk02", "19", "", music, 512, 2, 1, no},
    {"", "894a09f4", "mzk03", "20", "", music, 512, 2, 1, no},
    {"", "ec8a6ea7", "mzk04", "21", "", music, 512, 2, 1, no},
    {"", "d96b229e", "mzk05", "34", "", music, 512, 2, 1, no},
    {"", "48e2d9ef", "mzk06", "35", "", music, 512, 2, 1, no},
};

/// Returns the last part of a URL or path, without anything from `?` on.
std::string_view base_name_of(std::string_view source) {
    source = source.substr(0, source.find('?'));
    const size_t slash = source.find_last_of('/');
    return slash == std::string_view::npos ? source : source.substr(slash + 1);
}

/// Returns a path from ShaderToy's root as a path under the media folder; empty if it leads out of that
/// folder.
fs::path relative_path_of(std::string_view source) {
    const fs::path path = fs::path(source.substr(0, source.find('?'))).relative_path().lexically_normal();
    return path.empty() || *path.begin() == ".." ? fs::path() : path;
}

bool is_file(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

/// Returns `x.png` with `_3`, for example, before its extension.
std::string face_name(std::string_view base_name, int face) {
    const size_t dot = std::min(base_name.find_last_of('.'), base_name.size());
    return fmt::format("{}_{}{}", base_name.substr(0, dot), face, base_name.substr(dot));
}

Substitute generated(const StandIn& made) {
    constexpr std::string_view k_words[] = {"picture", "cubemap", "volume"};
    return {made,
            fmt::format("a generated {} of {}x{}", k_words[size_t(made.kind)], made.width, made.height)};
}

} // namespace

const Media* find_media(std::string_view source) {
    const std::string_view name = base_name_of(source);
    const std::string_view stem = name.substr(0, name.find_first_of("._"));
    for (const Media& media : k_media)
        if (name.starts_with(media.hash) || (!media.preset.empty() && stem == media.preset))
            return &media;
    return nullptr;
}

const Media* find_media_by_id(std::string_view id) {
    for (const Media& media : k_media)
        if (!id.empty() && (id == media.number || id == media.site_id))
            return &media;
    return nullptr;
}

MediaFolder::MediaFolder(fs::path folder) : folder_(std::move(folder)) {
    if (folder_.empty())
        return;
    for (const char* place : {"", "media/a", "a", "presets", "media"}) {
        std::error_code ignored;
        for (fs::directory_iterator entry(folder_ / place, ignored), end; !ignored && entry != end;
             entry.increment(ignored))
            if (is_file(entry->path()))
                files_.push_back(entry->path());
    }
    std::stable_sort(files_.begin(), files_.end(),
                     [](const fs::path& a, const fs::path& b) { return a.filename() < b.filename(); });
}

fs::path MediaFolder::by_beginning(std::string_view beginning) const {
    const auto found = std::lower_bound(
        files_.begin(), files_.end(), beginning,
        [](const fs::path& file, std::string_view wanted) { return file.filename().native() < wanted; });
    const bool fits = found != files_.end() && found->filename().native().starts_with(beginning);
    return fits ? *found : fs::path();
}

fs::path MediaFolder::by_name(std::string_view base_name) const {
    const fs::path found = base_name.empty() ? fs::path() : by_beginning(base_name);
    return found.filename() == base_name ? found : fs::path();
}

fs::path MediaFolder::find(std::string_view source) const {
    if (folder_.empty())
        return {};
    const fs::path path = relative_path_of(source);
    if (!path.empty() && is_file(folder_ / path))
        return folder_ / path;
    if (fs::path named = by_name(base_name_of(source)); !named.empty())
        return named;
    const Media* media = find_media(source);
    if (!media)
        return {};
    const fs::path later = by_beginning(media->hash);
    return !later.empty() || media->preset.empty() ? later : by_beginning(media->preset);
}

std::vector<fs::path> MediaFolder::find_cubemap(std::string_view source) const {
    const fs::path first = find(source);
    if (first.empty())
        return {};
    std::vector<fs::path> faces{first};
    const std::string name = first.filename().string();
    const bool preset = name.starts_with("cube") && name.find("_0.") != std::string::npos;
    const std::string base = preset ? name.substr(0, name.find("_0.")) + first.extension().string() : name;
    for (int face = 1; face < 6; ++face)
        if (fs::path file = first.parent_path() / face_name(base, face); is_file(file))
            faces.push_back(std::move(file));
    if (faces.size() == 1)
        return faces;
    return faces.size() == 6 ? faces : std::vector<fs::path>{};
}

Substitute substitute_for(MediaKind kind, const Media* media) {
    const bool known = media && media->kind == kind;
    if (known && media->noise)
        return {Noise{*media->noise}, {}};
    const auto make = [&](StandIn::Kind made, int width, int height) {
        return generated(known ? StandIn{made, media->width, media->height, media->channels}
                               : StandIn{made, width, height, 4});
    };
    switch (kind) {
    case picture: return make(StandIn::Kind::picture, 512, 512);
    case cubemap: return make(StandIn::Kind::cubemap, 256, 256);
    case volume: return make(StandIn::Kind::volume, 32, 32);
    case video: return make(StandIn::Kind::picture, 480, 360);
    case music: break;
    }
    return {Music{}, "ShaderToy's signal for silence"};
}

} // namespace tidemark::scene
