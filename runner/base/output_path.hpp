// Where an output goes: how much of its path a person named, and which files it must not replace. Links in
// the part that was named are the person's own and are followed; behind any other nothing is written, for the
// folder may be a stranger's. Makes and opens nothing.
#pragma once

#include "base/result.hpp"

#include <concepts>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace tidemark {

class OutputPath;
template <class Path>
concept PlainPath = std::constructible_from<std::filesystem::path, Path> &&
    !std::same_as<std::remove_cvref_t<Path>, OutputPath>;

class OutputPath {
public:
    OutputPath() = default;
    /// A name of our own choice: only the folder that it is in was named.
    template <PlainPath Path>
    OutputPath(Path&& path) // NOLINT(bugprone-forwarding-reference-overload): of no OutputPath
        : whole_(std::forward<Path>(path)), chosen_parts_(1) {}
    /// A person typed it, to its last part.
    static OutputPath typed(std::filesystem::path path);
    /// As typed; where nothing was, our own choice.
    static OutputPath typed_or(const std::filesystem::path& typed, std::filesystem::path choice);

    /// A name of our own choice in this folder.
    OutputPath operator/(const std::filesystem::path& name) const;
    /// A name of our own choice in the same folder: this one with that at its end.
    OutputPath beside(std::string_view ending) const;
    /// Files that are read and must not be replaced, here or below.
    OutputPath sparing(const std::vector<std::filesystem::path>& files) const;

    const std::filesystem::path& path() const { return whole_; }
    std::string string() const { return whole_.string(); }
    bool empty() const { return whole_.empty(); }

    /// Where the bytes go.
    struct Place {
        std::filesystem::path path{};    ///< its last part is no link
        std::optional<int> descriptor{}; ///< of this process, where that is what it names: `/dev/stdout`
        bool stream = false;             ///< a device, a pipe or such a descriptor: takes bytes as they come
    };
    /// Fails (ErrorCode::write) where a link lies that was not named, and on a file that is to be spared.
    Result<Place> place() const;
    /// As `place` does, of the links alone.
    Result<void> check_links() const;

private:
    Result<void> check_spared(const std::filesystem::path& final_path) const;

    std::filesystem::path whole_;
    size_t chosen_parts_ = 0; ///< of `whole_`, from its end: not named by anybody
    std::vector<std::filesystem::path> spared_;
};

} // namespace tidemark
