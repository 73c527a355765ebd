// The path of an output: how much of it the user named, and which files it must not replace. Links in the
// part that the user named are followed. Links in the rest are refused, since the folder may belong to
// another user. Makes and opens nothing.
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
    /// Makes a path whose last part the program chose: the user named only its folder.
    template <PlainPath Path>
    OutputPath(Path&& path) // NOLINT(bugprone-forwarding-reference-overload): of no OutputPath
        : whole_(std::forward<Path>(path)), chosen_parts_(1) {}
    /// Makes a path that the user typed, including its last part.
    static OutputPath typed(std::filesystem::path path);
    /// Returns the typed path, or the program's choice if none was typed.
    static OutputPath typed_or(const std::filesystem::path& typed, std::filesystem::path choice);

    /// Returns a path in this folder; the program chose the name.
    OutputPath operator/(const std::filesystem::path& name) const;
    /// Returns a path in the same folder, this one with `ending` appended; the program chose the name.
    OutputPath beside(std::string_view ending) const;
    /// Returns this path with input files that it, and paths made from it, must not replace.
    OutputPath sparing(const std::vector<std::filesystem::path>& files) const;

    const std::filesystem::path& path() const { return whole_; }
    std::string string() const { return whole_.string(); }
    bool empty() const { return whole_.empty(); }

    /// The resolved destination.
    struct Place {
        std::filesystem::path path{};    ///< its last part is not a link, unless `descriptor` is set
        /// the descriptor of this process that the path names: `/dev/stdout`
        std::optional<int> descriptor{};
        bool stream = false;             ///< a device, a pipe or such a descriptor: written to directly
    };
    /// Resolves the destination. Fails (ErrorCode::write) on a link that the user did not name, and on a file
    /// that must not be replaced.
    Result<Place> place() const;
    /// Checks only the links, as `place` does.
    Result<void> check_links() const;

private:
    Result<void> check_spared(const std::filesystem::path& final_path) const;

    std::filesystem::path whole_;
    size_t chosen_parts_ = 0; ///< number of parts at the end of `whole_` that the program chose
    std::vector<std::filesystem::path> spared_;
};

} // namespace tidemark
