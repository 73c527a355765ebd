// Finds the place in the text of a project's JSON at which a line of a pass's code stands. Other places in
// JSON are not its business.

#include "editor/session.hpp"

#include "base/encoding.hpp"
#include "base/tokens.hpp"
#include "scene/project.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace tidemark::lsp {
namespace fs = std::filesystem;
namespace {

size_t end_of_string(std::string_view json, size_t begin) {
    size_t at = begin;
    while (at < json.size() && json[at] != '"')
        at += json[at] == '\\' ? 2 : 1;
    return std::min(at, json.size());
}

/// Returns the inside of the string value of the n-th key "code", from 0, with its escapes. The JSON must be
/// valid.
std::optional<std::pair<size_t, size_t>> find_code(std::string_view json, size_t n) {
    for (size_t at = json.find('"'); at != json.npos; at = json.find('"', at)) {
        const size_t end = end_of_string(json, at + 1);
        const bool is_code = json.substr(at + 1, end - at - 1) == "code";
        at = std::min(end + 1, json.size());
        const size_t colon = json.find_first_not_of(" \t\r\n", at);
        if (!is_code || colon == json.npos || json[colon] != ':')
            continue;
        const size_t value = json.find_first_not_of(" \t\r\n", colon + 1);
        if (value == json.npos || json[value] != '"')
            continue;
        if (n-- == 0)
            return std::pair(value + 1, end_of_string(json, value + 1));
        at = value;
    }
    return std::nullopt;
}

/// Returns the offset after the line end at `at`, or 0 if there is none: \n, \r or \r\n, escaped.
size_t after_line_end(std::string_view json, size_t at) {
    if (json.substr(at, 4) == "\\r\\n")
        return at + 4;
    const std::string_view two = json.substr(at, 2);
    return two == "\\n" || two == "\\r" ? at + 2 : 0;
}

/// Returns the offsets of a line's first byte and of its end in `json`, where the code is one string with
/// escapes. `pass` is a name by scene::pass_names, `line` counts from 1. None if the JSON has no such pass or
/// line.
std::optional<std::pair<size_t, size_t>> find_code_line(std::string_view json, std::string_view pass,
                                                        int line) {
    const auto project = scene::read_project(json, "");
    if (!project)
        return std::nullopt;
    const auto names = scene::pass_names(*project);
    const auto name = std::ranges::find(names, pass);
    const auto code = find_code(json, size_t(name - names.begin()));
    if (name == names.end() || !code)
        return std::nullopt;
    size_t begin = code->first, at = begin;
    while (at < code->second) {
        const size_t next = after_line_end(json, at);
        if (next == 0) {
            at += json[at] == '\\' ? 2 : 1;
            continue;
        }
        if (line == 1)
            break;
        --line;
        begin = at = next;
    }
    if (line == 1)
        return std::pair(begin, std::min(at, code->second));
    return std::nullopt;
}

enum class Level { error = 1, warning, information, hint };

Level level_of(Severity severity) {
    return severity == Severity::error     ? Level::error
           : severity == Severity::warning ? Level::warning
                                           : Level::information;
}

/// Returns the range of the token at the place; of the whole line where no column is known.
Json range_of(const SourceLocation& where, std::string_view text, Encoding encoding) {
    const Lines lines(text, encoding);
    const size_t begin = lines.begin_of(where.line), end = lines.end_of(where.line);
    const std::string_view line = text.substr(begin, end - begin);
    if (where.column < 1)
        return lines.range(begin + std::min(line.find_first_not_of(" \t"), line.size()), end);
    const size_t at = std::min(begin + size_t(where.column) - 1, end);
    const int past = text::end_of_token(line, where.column);
    return lines.range(at, past > 0 ? begin + size_t(past) - 1 : std::min(at + 1, end));
}

class Translator {
public:
    Translator(const Documents& documents, fs::path main, Encoding encoding)
        : documents_(documents), main_(std::move(main)), encoding_(encoding) {}

    fs::path file_of(const SourceLocation& where) const {
        if (where.file.empty())
            return main_;
        const auto pass = pass_in_json(where.file);
        return canonical_name(pass ? pass->json : where.file);
    }

    Json to_json(const Diagnostic& diagnostic, Level level) {
        return {{"range", range(diagnostic.where)},
                {"severity", int(level)},
                {"source", "tidemark"},
                {"message", diagnostic.message}};
    }

    /// Returns a note as related information of the diagnostic before it.
    Json related(const Diagnostic& note) {
        return {{"location", {{"uri", documents_.uri_of(file_of(note.where))}, {"range", range(note.where)}}},
                {"message", note.message}};
    }

private:
    struct PassInJson {
        std::string json, pass;
    };

    /// Takes the name of a project's pass apart: `waves.json:Buffer A`.
    static std::optional<PassInJson> pass_in_json(const std::string& place) {
        const size_t colon = place.rfind(".json:");
        if (colon == place.npos)
            return std::nullopt;
        return PassInJson{place.substr(0, colon + 5), place.substr(colon + 6)};
    }

    Json range(const SourceLocation& where) {
        const fs::path file = file_of(where);
        auto text = texts_.find(file);
        if (text == texts_.end())
            text = texts_.emplace(file, documents_.text_of(file).value_or("")).first;
        if (const auto pass = pass_in_json(where.file))
            if (const auto line = find_code_line(text->second, pass->pass, where.line))
                return Lines(text->second, encoding_).range(line->first, line->second);
        return range_of(where, text->second, encoding_);
    }

    const Documents& documents_;
    fs::path main_;
    Encoding encoding_;
    std::map<fs::path, std::string> texts_;
};

std::map<fs::path, Json> by_file(const Verdict& verdict, Translator translator) {
    std::map<fs::path, Json> files;
    Json* last = nullptr; // the diagnostic that the next notes belong to
    for (const Diagnostic& problem : verdict.problems) {
        if (problem.severity == Severity::note && last)
            (*last)["relatedInformation"].push_back(translator.related(problem));
        else
            last = &files[translator.file_of(problem.where)].emplace_back(
                translator.to_json(problem, level_of(problem.severity)));
    }
    for (const Diagnostic& hint : verdict.hints)
        files[translator.file_of(hint.where)].push_back(translator.to_json(hint, Level::hint));
    return files;
}

std::string joined(const std::vector<Json>& messages) {
    std::string text;
    for (const Json& message : messages)
        text += framed(message);
    return text;
}

/// Returns nothing for a URI that is not a file of this machine.
std::optional<fs::path> file_of(const Json& params) {
    const auto file = path_of_uri(params.at("textDocument").at("uri").get<std::string>());
    return file ? std::optional(canonical_name(*file)) : std::nullopt;
}

bool offers_utf8(const Json& params) {
    const Json offered = params.value("/capabilities/general/positionEncodings"_json_pointer, Json::array());
    return std::ranges::find(offered, Json("utf-8")) != offered.end();
}

constexpr std::string_view k_execute = "workspace/executeCommand";
/// Editors ignore notifications of this form that they do not know.
constexpr std::string_view k_measured = "$/tidemark/measured";
constexpr std::pair<std::string_view, Order::Kind> k_commands[] = {
    {"tidemark.openPreview", Order::Kind::open_preview},
    {"tidemark.openWindow", Order::Kind::open_window},
    {"tidemark.closePreview", Order::Kind::close_preview},
};

/// Returns the member, or null if the object does not have it.
Json member(const Json& object, const char* name) {
    return object.is_object() && object.contains(name) ? object[name] : Json();
}

/// Returns the texts of a member that is a text or a list of texts; none if it is missing.
std::vector<std::string> texts_of(const Json& object, const char* name) {
    const Json given = member(object, name);
    if (given.is_null())
        return {};
    return given.is_array() ? given.get<std::vector<std::string>>() : std::vector{given.get<std::string>()};
}

} // namespace

std::vector<Json> DiagnosticBoard::show(From from, const fs::path& scene, const fs::path& main,
                                        const Verdict& verdict, const Documents& documents,
                                        Encoding encoding) {
    Files files = by_file(verdict, Translator(documents, main, encoding));
    std::set<fs::path> touched{main}; // an empty list clears the file
    Files& shown = scenes_[{scene, from}];
    for (const auto* each : {&shown, &files})
        for (const auto& [file, list] : *each)
            touched.insert(file);
    shown = std::move(files);
    return publish(touched, documents);
}

std::vector<Json> DiagnosticBoard::forget(From from, const fs::path& scene, const Documents& documents) {
    std::set<fs::path> touched;
    for (const auto& [file, list] : scenes_[{scene, from}])
        touched.insert(file);
    scenes_.erase({scene, from});
    return publish(touched, documents);
}

std::vector<Json> DiagnosticBoard::publish(const std::set<fs::path>& touched,
                                           const Documents& documents) const {
    std::vector<Json> notifications;
    for (const fs::path& file : touched) {
        Json list = Json::array();
        for (const auto& [key, files] : scenes_)
            if (const auto found = files.find(file); found != files.end())
                for (const Json& diagnostic : found->second)
                    if (std::ranges::find(list, diagnostic) == list.end())
                        list.push_back(diagnostic);
        Json params = {{"uri", documents.uri_of(file)}, {"diagnostics", std::move(list)}};
        if (const Document* document = documents.find(file))
            params["version"] = document->version;
        notifications.push_back(notification("textDocument/publishDiagnostics", std::move(params)));
    }
    return notifications;
}

std::string Session::receive(std::string_view text) {
    const Json message = Json::parse(text, nullptr, false);
    if (message.is_discarded())
        return framed(error_response(nullptr, ErrorNumber::parse_error, "the message is not JSON"));
    if (!message.is_object() || !member(message, "method").is_string())
        return message.is_object() && message.contains("result")
                   ? "" // a response, although no request was sent
                   : framed(error_response(nullptr, ErrorNumber::invalid_request,
                                           "a message must be an object with a method"));
    return answer(message);
}

std::string Session::answer(const Json& message) {
    const std::string method = message["method"];
    const Json params = member(message, "params");
    const bool asks = message.contains("id");
    const Json id = member(message, "id");
    try { // a member is missing or has another type
        if (!asks)
            return notified(method, params);
        if (method == k_execute && phase_ == Phase::running)
            return command(id, params);
        Answer result = request(method, params);
        return framed(result ? response(id, *std::move(result))
                             : error_response(id, result.error().number, result.error().message));
    } catch (const Json::exception& wrong) {
        const std::string words = fmt::format("{}: {}", method, wrong.what());
        return asks ? framed(error_response(id, ErrorNumber::invalid_params, words))
                    : framed(notification("window/logMessage", {{"type", 2}, {"message", words}}));
    }
}

/// Notes a command for the owner of the session; returns a response only if it is refused.
std::string Session::command(const Json& id, const Json& params) {
    const auto refused = [&](ErrorNumber number, const std::string& why) {
        return framed(error_response(id, number, why));
    };
    const auto name = params.at("command").get<std::string>();
    const auto known = std::ranges::find(k_commands, name, &std::pair<std::string_view, Order::Kind>::first);
    if (known == std::end(k_commands))
        return refused(ErrorNumber::invalid_params, fmt::format("there is no command '{}'", name));
    const Json arguments = params.value("arguments", Json::array());
    if (arguments.empty() && !recent_.empty()) {
        orders_.push_back({known->second, id, recent_, {}, {}});
        return "";
    }
    const std::string uri = arguments.at(0);
    const auto path = path_of_uri(uri);
    if (!path)
        return refused(ErrorNumber::invalid_params,
                       fmt::format("{} names no file of this machine: save it first", uri));
    const fs::path file = canonical_name(*path);
    const auto open = scenes_.find(file);
    const auto scene = open != scenes_.end() ? std::optional(open->second) : scene_of(file, documents_);
    if (!scene)
        return refused(ErrorNumber::request_failed,
                       fmt::format("'{}' is no scene: it has no mainImage, and no scene beside or above it "
                                   "includes it",
                                   file.filename().string()));
    const Json options = arguments.size() > 1 ? arguments[1] : Json();
    orders_.push_back(
        {known->second, id, *scene, texts_of(options, "ancestor"), texts_of(options, "origin")});
    return "";
}

Answer Session::request(const std::string& method, const Json& params) {
    if (method == "initialize")
        return initialize(params);
    if (phase_ == Phase::fresh)
        return refuse(ErrorNumber::not_initialized, "`initialize` must come first");
    if (phase_ == Phase::shut_down)
        return refuse(ErrorNumber::invalid_request, "after `shutdown` only `exit` is allowed");
    if (method == "completionItem/resolve")
        return resolved_completion(params);
    if (method != "shutdown")
        return ask(method, params);
    phase_ = Phase::shut_down;
    return Json();
}

/// Answers a request about a document.
Answer Session::ask(const std::string& method, const Json& params) const {
    const AnswerTo question = find_question(method);
    if (!question)
        return refuse(ErrorNumber::method_not_found, fmt::format("{} is not supported", method));
    return workspace_of(params).and_then([&](const Workspace& workspace) -> Answer {
        if (workspace.files.front().path.extension() ==
            ".json") // its text is no GLSL: it has diagnostics alone
            return Json();
        const Question asked{workspace, params, documents_, encoding_};
        Answer answer = question(asked);
        const auto scene = scenes_.find(workspace.files.front().path);
        if (method != "textDocument/codeAction" || !answer || scene == scenes_.end())
            return answer;
        if (const auto found = measured_.find(scene->second);
            found != measured_.end() && found->second.texts == texts_of_scene(scene->second))
            for (Json& action : fix_actions(asked, found->second.fixes, versioned_edits_))
                answer->push_back(std::move(action));
        return answer;
    });
}

std::string Session::notified(const std::string& method, const Json& params) {
    if (method == "exit")
        exit_code_ = phase_ == Phase::shut_down ? 0 : 1;
    if (phase_ != Phase::running)
        return "";
    std::string told;
    if (method == "textDocument/didOpen")
        told = open(params);
    else if (method == "textDocument/didChange")
        told = change(params);
    else if (method == "textDocument/didClose")
        told = close(params);
    else if (method == "textDocument/didSave" || method == "workspace/didChangeWatchedFiles")
        saved();
    return told + drop_outdated();
}

Answer Session::initialize(const Json& params) {
    if (phase_ != Phase::fresh)
        return refuse(ErrorNumber::invalid_request, "`initialize` may come only once");
    encoding_ = offers_utf8(params.is_object() ? params : Json::object()) ? Encoding::utf8 : Encoding::utf16;
    const auto k_versioned = "/capabilities/workspace/workspaceEdit/documentChanges"_json_pointer;
    versioned_edits_ = params.is_object() && params.value(k_versioned, false);
    phase_ = Phase::running;
    Json commands = Json::array();
    for (const auto& [name, kind] : k_commands)
        commands.push_back(name);
    constexpr int k_whole_texts = 1;
    return Json{{"serverInfo", {{"name", "tidemark"}, {"version", version_}}},
                {"capabilities",
                 {{"positionEncoding", encoding_ == Encoding::utf8 ? "utf-8" : "utf-16"},
                  {"textDocumentSync", {{"openClose", true}, {"change", k_whole_texts}, {"save", true}}},
                  {"hoverProvider", true},
                  {"definitionProvider", true},
                  {"documentSymbolProvider", true},
                  {"colorProvider", true},
                  {"renameProvider", {{"prepareProvider", true}}},
                  {"referencesProvider", true},
                  {"documentHighlightProvider", true},
                  {"completionProvider",
                   {{"triggerCharacters", {".", "#", "\"", "<", "/", ":"}}, {"resolveProvider", true}}},
                  {"signatureHelpProvider", {{"triggerCharacters", {"(", ","}}}},
                  {"semanticTokensProvider", {{"legend", semantic_legend()}, {"full", true}}},
                  {"foldingRangeProvider", true},
                  {"codeActionProvider", {{"codeActionKinds", Json::array({"quickfix"})}}},
                  {"executeCommandProvider", {{"commands", std::move(commands)}}}}}};
}

tl::expected<Workspace, Refusal> Session::workspace_of(const Json& params) const {
    const auto file = file_of(params);
    if (!file)
        return refuse(ErrorNumber::invalid_params,
                      fmt::format("{} names no file of this machine: only file: URIs can be read",
                                  params["textDocument"]["uri"].dump()));
    if (const auto text = documents_.text_of(*file); !text)
        return refuse(ErrorNumber::invalid_params, text.error().message);
    const auto known = scenes_.find(*file);
    return look_around(*file, known == scenes_.end() ? std::nullopt : std::optional(known->second),
                       documents_);
}

std::string Session::open(const Json& params) {
    const Json& document = params.at("textDocument");
    const auto file = file_of(params);
    if (!file)
        return ""; // a text without a file has no scene
    documents_.hold(*file, {document.at("uri"), document.value("version", 0)},
                    document.at("text").get<std::string>());
    ++revisions_;
    return take_up(*file);
}

std::string Session::change(const Json& params) {
    const auto file = file_of(params);
    const Json& changes = params.at("contentChanges");
    if (!file || !documents_.find(*file) || changes.empty())
        return "";
    const Json& document = params["textDocument"];
    documents_.hold(*file, {document["uri"], document.value("version", 0)},
                    changes.back().at("text").get<std::string>());
    ++edits_;
    ++revisions_;
    return take_up(*file);
}

std::string Session::close(const Json& params) {
    const auto file = file_of(params);
    const auto known = file ? scenes_.find(*file) : scenes_.end();
    if (file)
        documents_.release(*file);
    ++revisions_;
    if (known == scenes_.end())
        return "";
    const fs::path scene = known->second;
    scenes_.erase(known);
    return leave(scene);
}

void Session::saved() {
    files_of_.clear();
    for (const auto& [file, scene] : scenes_)
        stale_.insert(scene);
}

/// Assigns the file to its scene. A file that has lost its entry point while being edited stays with its
/// scene. Other open scenes may include it and are marked, too.
std::string Session::take_up(const fs::path& file) {
    const auto scene = scene_of(file, documents_);
    const fs::path before = std::exchange(scenes_[file], scene.value_or(scenes_[file]));
    recent_ = scenes_[file];
    recent_compiles_ = false;
    if (recent_.empty())
        scenes_.erase(file);
    note_files(file);
    return before.empty() || !scene || *scene == before ? "" : leave(before);
}

/// Marks the scenes that read the file, or may now. Loads only those again, since hundreds may be open.
void Session::note_files(const fs::path& file) {
    for (const auto& [open, scene] : scenes_) {
        std::set<fs::path>& files = files_of_[scene];
        if (open == file || files.empty() || files.contains(file))
            files = files_of(scene, documents_);
        if (open == file || files.contains(file))
            stale_.insert(scene);
    }
}

/// Handles that a file of the scene was closed: if others are open, the scene is checked again with the text
/// on disk; else its diagnostics are removed.
std::string Session::leave(const fs::path& scene) {
    if (std::ranges::any_of(scenes_, [&](const auto& each) { return each.second == scene; })) {
        stale_.insert(scene);
        return "";
    }
    stale_.erase(scene);
    files_of_.erase(scene);
    if (recent_ == scene)
        recent_.clear();
    measured_.erase(scene);
    return joined(board_.forget(DiagnosticBoard::From::compiler, scene, documents_)) +
           joined(board_.forget(DiagnosticBoard::From::measurement, scene, documents_));
}

std::string Session::conclude(const fs::path& scene, const Verdict& verdict) {
    const auto open = std::ranges::find_if(scenes_, [&](const auto& each) { return each.second == scene; });
    if (open == scenes_.end())
        return ""; // closed in the meantime
    if (scene == recent_)
        recent_compiles_ = std::ranges::none_of(
            verdict.problems, [](const Diagnostic& each) { return each.severity == Severity::error; });
    return joined(
        board_.show(DiagnosticBoard::From::compiler, scene, open->first, verdict, documents_, encoding_));
}

std::optional<fs::path> Session::unmeasured() const {
    const bool wanted = recent_compiles_ && !recent_.empty() && !measured_.contains(recent_);
    return wanted ? std::optional(recent_) : std::nullopt;
}

/// Returns the texts of the scene's files.
std::map<fs::path, std::string> Session::texts_of_scene(const fs::path& scene) const {
    std::map<fs::path, std::string> texts;
    const auto known = files_of_.find(scene);
    for (const fs::path& file : known == files_of_.end() ? files_of(scene, documents_) : known->second)
        texts[file] = documents_.text_of(file).value_or("");
    return texts;
}

void Session::begin_measuring(const fs::path& scene) {
    measured_[scene] = {texts_of_scene(scene)};
}

/// Forgets what was measured in scenes that may have other texts now and do.
std::string Session::drop_outdated() {
    std::string told;
    for (const fs::path& scene : stale_) {
        const auto found = measured_.find(scene);
        if (found == measured_.end() || found->second.texts == texts_of_scene(scene))
            continue;
        measured_.erase(found);
        told += joined(board_.forget(DiagnosticBoard::From::measurement, scene, documents_));
        told += framed(notification(k_measured, {{"scene", scene.string()}}));
    }
    return told;
}

std::string Session::show_error(const fs::path& scene, Json error) const {
    if (!measured_.contains(scene))
        return ""; // its texts have changed
    error["scene"] = scene.string();
    return framed(notification(k_measured, std::move(error)));
}

std::string Session::show_fix(const fs::path& scene, MeasuredFix fix) {
    const auto open = std::ranges::find_if(scenes_, [&](const auto& each) { return each.second == scene; });
    const auto found = measured_.find(scene);
    if (open == scenes_.end() || found == measured_.end())
        return "";
    for (MeasuredFix::File& file : fix.files)
        file.name = canonical_name(file.name);
    found->second.fixes.push_back(std::move(fix));
    return joined(board_.show(DiagnosticBoard::From::measurement, scene, open->first,
                              {.hints = fix_hints(found->second.fixes, documents_)}, documents_, encoding_));
}

} // namespace tidemark::lsp
