#include "cli/project_source.hpp"

#include "base/child_process.hpp"
#include "base/file.hpp"
#include "base/shell_word.hpp"
#include "base/try.hpp"
#include "cli/output_name.hpp"
#include "scene/saved_project.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>

namespace tidemark::cli {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view k_advice =
    ": give --via a file that holds the project, or a program that prints the one of the ID behind its words";

/// Returns true for a file to read, not a folder or a program.
bool is_document(const fs::path& path) {
    std::error_code ignored;
    if (!fs::exists(path, ignored) || fs::is_directory(path, ignored))
        return false;
    const fs::path ending = path.extension();
    return ending == ".json" || ending == ".html" || ending == ".htm" || ::access(path.c_str(), X_OK) != 0;
}

/// Splits a command into arguments; the path of an existing file is one argument even if it contains spaces.
/// A name without a folder is searched in PATH only, as shells do: a file in the current folder may be
/// untrusted.
std::vector<std::string> words_of(const std::string& command) {
    std::error_code ignored;
    const bool is_path = command.find('/') != command.npos && fs::is_regular_file(command, ignored);
    return is_path ? std::vector{command} : split_words(command);
}

/// Runs the command with the ID and returns its output.
Result<std::string> printed_by(const ProjectSource& source, const std::string& id) {
    std::vector<std::string> words = words_of(source.via);
    if (words.empty())
        return fail(ErrorCode::usage, "--via is empty" + std::string(k_advice));
    words.push_back(id);
    const auto time = std::chrono::duration<double>(source.timeout);
    const auto until =
        ChildProcess::Clock::now() + std::chrono::duration_cast<ChildProcess::Clock::duration>(time);
    auto printed = output_of(words, {k_largest_text, until}, k_advice);
    if (printed && printed->find_first_not_of(" \t\r\n") != printed->npos)
        return printed;
    const std::string command = fmt::format("'{} {}'", source.via, id);
    if (printed)
        return fail(ErrorCode::load,
                    fmt::format("{} printed nothing: it is to print the project's JSON", command));
    Error error = std::move(printed.error());
    if (error.code == ErrorCode::timed_out)
        error.message = fmt::format("it took longer than --timeout {:g}", source.timeout);
    if (error.message.empty())
        error.message = "it failed without a word";
    error.message = fmt::format("{}: {}", command, error.message);
    return fail(std::move(error));
}

Result<FoundProject> found_via(const ProjectSource& source) {
    const std::string id = TRY(scene::project_id(source.project));
    const bool document = is_document(source.via);
    auto text = TRY(document ? read_file(source.via) : printed_by(source, id));
    auto json = TRY(scene::saved_project(std::move(text), id, source.via));
    FoundProject found = {std::move(json), source.via, id, {}};
    if (document)
        found.read = {source.via};
    return found;
}

} // namespace

Result<FoundProject> find_project(const ProjectSource& source) {
    if (!source.via.empty())
        return found_via(source);
    std::error_code ignored;
    if (!fs::exists(source.project, ignored) && scene::project_id(source.project))
        return fail(
            ErrorCode::usage,
            fmt::format("'{}': no network is asked here. Save the project and give --via FILE, or a program "
                        "of yours that fetches it: --via COMMAND",
                        source.project));
    auto text = TRY(read_file(source.project));
    auto json = TRY(scene::saved_project(std::move(text), "", source.project));
    return FoundProject{
        std::move(json), source.project, name_after_scene(source.project, ""), {source.project}};
}

} // namespace tidemark::cli
