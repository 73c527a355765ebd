#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/try.hpp"
#include "cli/command_line.hpp"
#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/json_dump.hpp"
#include "cli/project_source.hpp"
#include "cli/version.hpp"
#include "scene/project_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <memory>
#include <span>
#include <system_error>

namespace tidemark::cli {
namespace fs = std::filesystem;
namespace {

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
Result<void> prepare_folder(const fs::path& folder, const Receipt& receipt, bool force) {
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && !force && entry != end;
         entry.increment(error))
        if (entry->path().filename() != k_receipt && !is_as_written(entry->path(), receipt))
            return fail(
                ErrorCode::write,
                fmt::format("'{}' was not written by import, or has changed since: give another folder with "
                            "-o, or --force to write into this one",
                            entry->path().string()));
    if (error)
        return fail(ErrorCode::write,
                    fmt::format("cannot read the folder '{}': {}", folder.string(), error.message()));
    return {};
}

/// Writes the project's files into the folder and returns their names.
Result<std::vector<std::string>> write_project(const FoundProject& project, const OutputPath& output,
                                               bool force) {
    const auto files = TRY(scene::split_project(project.json, project.from));
    TRY(make_folder(output));
    const fs::path& folder = output.path();
    const Receipt old = read_receipt(folder);
    TRY(prepare_folder(folder, old, force));
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
    const auto names = TRY(write_project(project, output, options.force));
    if (!options.json)
        return 0;
    const nlohmann::ordered_json report = {
        {"tidemark", k_version}, {"folder", output.path().string()}, {"files", names}};
    return put(dump(report, 2) + "\n").map([] { return 0; });
}

} // namespace

Result<fs::path> import_beside(const fs::path& json) {
    const auto project = TRY(find_project({json.string(), {}, {}}));
    fs::path folder = json.parent_path() / project.name;
    TRY(write_project(project, OutputPath::typed(folder).sparing(project.read), false));
    return folder;
}

void add_import(Command app, Action& chosen) {
    auto options = std::make_shared<ImportOptions>();
    Command command = app.add_subcommand("import", "Makes a scene folder of a ShaderToy project");
    command
        .add_option("FILE", options->source.project,
                    "A project's JSON or a saved page of it; with --via its ID or address")
        .required();
    command.add_option("-o,--output", options->folder, "Folder (default: the name of the file, or the ID)")
        .type_name("FOLDER");
    const Option via = command.add_option(
        "--via", options->source.via, "A file that holds the project, or a program of yours that prints it");
    via.type_name("FILE|COMMAND");
    command
        .add_option("--timeout", options->source.timeout,
                    "Gives the command of --via up after so many seconds")
        .type_name("S")
        .needs(via)
        .check(number<double>("a number of seconds above 0", 1e-3, 1e6))
        .capture_default_str();
    command.add_flag("--force", options->force, "Write into a folder that holds other files too");
    command.add_flag("--json", options->json, "One JSON object on standard output");
    command.on_call([options, &chosen] { chosen = [options] { return import(*options); }; });
}

} // namespace tidemark::cli
