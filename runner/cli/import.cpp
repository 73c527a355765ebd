#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/process.hpp"
#include "cli/commands.hpp"
#include "host/command_line.hpp"
#include "host/console.hpp"
#include "host/frame_files.hpp"
#include "host/json.hpp"
#include "host/requests.hpp"
#include "scene/load_scene.hpp"
#include "scene/project_exchange.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <span>
#include <system_error>

namespace tidemark::cli {

using namespace host;
namespace fs = std::filesystem;
namespace {

struct ProjectSource {
    std::string project;   ///< a file; with `via` a project's ID or URL
    std::string via;       ///< a file that holds it, or a command line that prints it
    double timeout = 60.0; ///< timeout of the command in seconds
};

struct FoundProject {
    std::string json;
    std::string from;                        ///< for messages
    std::filesystem::path name;              ///< default name of the output folder
    std::vector<std::filesystem::path> read; ///< files that must not be overwritten
};

constexpr std::string_view k_advice = ": give --via a file that holds the project, or a program that takes "
                                      "the project's ID as its last argument and prints the JSON";

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
                    fmt::format("{} printed nothing; it should print the project's JSON", command));
    Error error = std::move(printed.error());
    if (error.code == ErrorCode::timed_out)
        error.message = fmt::format("it took longer than --timeout {:g} s", source.timeout);
    if (error.message.empty())
        error.message = "it failed without a message";
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

Result<FoundProject> find_project(const ProjectSource& source) {
    if (!source.via.empty())
        return found_via(source);
    std::error_code ignored;
    if (!fs::exists(source.project, ignored) && scene::project_id(source.project))
        return fail(ErrorCode::usage,
                    fmt::format("'{}': Tidemark makes no network requests. Save the project and give --via "
                                "FILE, or a program of yours that fetches it: --via COMMAND",
                                source.project));
    auto text = TRY(read_file(source.project));
    auto json = TRY(scene::saved_project(std::move(text), "", source.project));
    return FoundProject{
        std::move(json), source.project, name_after_scene(source.project, ""), {source.project}};
}

/// The list of files that import wrote, in the format of `sha256sum -c`: every other file in the folder
/// belongs to the user.
constexpr const char* k_receipt = ".tidemark-import";

using Receipt = std::map<std::string, std::string>; ///< SHA-256 by file

struct ImportOptions {
    ProjectSource source;
    fs::path folder;
    bool force = false;
    bool json = false;
};

std::string content_hash(std::string_view bytes) {
    return sha256(std::as_bytes(std::span(bytes)));
}

Receipt read_receipt(const fs::path& folder) {
    constexpr size_t k_hash_digits = 64;
    Receipt receipt;
    const auto text = read_file(folder / k_receipt);
    if (!text)
        return receipt;
    std::string_view rest = *text;
    while (!rest.empty()) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(rest.size(), line.size() + 1));
        // Only plain names: listed files may be deleted later, so a path must not lead out of the folder.
        if (line.size() > k_hash_digits + 2 && line.find('/') == line.npos)
            receipt[std::string(line.substr(k_hash_digits + 2))] = std::string(line.substr(0, k_hash_digits));
    }
    return receipt;
}

bool is_as_written(const fs::path& file, const Receipt& receipt) {
    const auto written = receipt.find(file.filename().string());
    if (written == receipt.end())
        return false;
    const auto bytes = read_file(file);
    return bytes && content_hash(*bytes) == written->second;
}

/// Checks that the folder may be written into: with `force`, or if import wrote all of its files and none has
/// changed.
Result<void> prepare_folder(const fs::path& folder, const Receipt& receipt, bool force,
                            std::string_view advice) {
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && !force && entry != end;
         entry.increment(error))
        if (entry->path().filename() != k_receipt && !is_as_written(entry->path(), receipt))
            return fail(ErrorCode::write,
                        fmt::format("'{}' was not written by import, or was changed since: {}",
                                    entry->path().string(), advice));
    if (error)
        return fail(ErrorCode::write,
                    fmt::format("cannot read the folder '{}': {}", folder.string(), error.message()));
    return {};
}

/// Writes the project's files into the folder and returns their names.
Result<std::vector<std::string>> write_project(const FoundProject& project, const OutputPath& output,
                                               bool force, std::string_view advice) {
    const auto files = TRY(scene::split_project(project.json, project.from));
    TRY(make_folder(output));
    const fs::path& folder = output.path();
    const Receipt old = read_receipt(folder);
    TRY(prepare_folder(folder, old, force, advice));
    for (const scene::ProjectFile& file : files)
        TRY((output / file.name).place());

    std::string receipt;
    std::vector<std::string> names;
    for (const scene::ProjectFile& file : files) {
        TRY(write_file(output / file.name, file.bytes));
        receipt += fmt::format("{}  {}\n", content_hash(file.bytes), file.name);
        names.push_back(file.name);
    }
    std::error_code ignored;
    for (const auto& [name, hash] : old) // a file of a pass that was removed from the project
        if (std::find(names.begin(), names.end(), name) == names.end() && is_as_written(folder / name, old))
            fs::remove(folder / name, ignored);
    TRY(write_file(output / k_receipt, receipt));
    say(fmt::format("wrote {}: {}", folder.string(), fmt::join(names, ", ")));
    return names;
}

Result<int> import(const ImportOptions& options) {
    const auto project = TRY(find_project(options.source));
    const OutputPath output = OutputPath::typed_or(options.folder, project.name).sparing(project.read);
    const auto names = TRY(write_project(project, output, options.force,
                                         "give another folder with -o, or --force to overwrite"));
    if (!options.json)
        return 0;
    const nlohmann::ordered_json report = {
        {"tidemark", k_version}, {"folder", output.path().string()}, {"files", names}};
    return put(dump(report, 2) + "\n").map([] { return 0; });
}

/// Imports the project of a JSON file into the folder beside it that is named like it, and returns the
/// folder. Prints what it writes. Fails (ErrorCode::write) if that folder holds other files, or files edited
/// since an import.
Result<fs::path> import_beside(const fs::path& json) {
    const auto project = TRY(find_project({json.string(), {}, {}}));
    fs::path folder = json.parent_path() / project.name;
    // The program chose the folder's name, so no link is followed there.
    TRY(write_project(project, OutputPath(folder).sparing(project.read), false,
                      fmt::format("to edit these files, give '{}' instead of the JSON", folder.string())));
    return folder;
}

} // namespace

Result<scene::Scene> load_editable(SceneRequest& request) {
    if (request.path.extension() == ".json") {
        const scene::Scene scene =
            TRY(scene::load_scene(request.path, request.files)); // `load` says its warnings
        if (scene.file.extension() == ".json") { // a folder's scene.json stands for the folder
            request.path = TRY(import_beside(scene.file));
            if (request.files.media.empty()) // files that the project names lie beside its JSON
                request.files.media = scene.file.parent_path().empty() ? "." : scene.file.parent_path();
        }
    }
    return load(request);
}

void add_import(Command app, Action& chosen) {
    auto options = std::make_shared<ImportOptions>();
    Command command = app.add_subcommand("import", "Makes a scene folder from a ShaderToy project");
    command
        .add_option("FILE", options->source.project,
                    "The project's JSON or its saved page; with --via: its ID or address")
        .required();
    command.add_option("-o,--output", options->folder, "Folder (default: the name of the file, or the ID)")
        .type_name("FOLDER");
    const Option via = command.add_option(
        "--via", options->source.via, "A file that holds the project, or a program of yours that prints it");
    via.type_name("FILE|COMMAND");
    command
        .add_option("--timeout", options->source.timeout, "Stops the command of --via after so many seconds")
        .type_name("S")
        .needs(via)
        .check(number<double>("a number of seconds above 0", 1e-3, 1e6))
        .capture_default_str();
    command.add_flag("--force", options->force, "Writes even if the folder holds other files");
    command.add_flag("--json", options->json, "Prints one JSON object");
    command.on_call([options, &chosen] { chosen = [options] { return import(*options); }; });
}

} // namespace tidemark::cli
