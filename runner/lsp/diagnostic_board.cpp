#include "lsp/diagnostic_board.hpp"

#include "lsp/json_place.hpp"
#include "text/token_at.hpp"

#include <algorithm>
#include <optional>

namespace tidemark::lsp {
namespace fs = std::filesystem;
namespace {

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

} // namespace

std::vector<Json> DiagnosticBoard::show(const fs::path& scene, const fs::path& main, const Verdict& verdict,
                                        const Documents& documents, Encoding encoding) {
    Files files = by_file(verdict, Translator(documents, main, encoding));
    std::set<fs::path> touched{main}; // an empty list clears the file
    for (const auto* each : {&scenes_[scene], &files})
        for (const auto& [file, list] : *each)
            touched.insert(file);
    scenes_[scene] = std::move(files);
    return publish(touched, documents);
}

std::vector<Json> DiagnosticBoard::forget(const fs::path& scene, const Documents& documents) {
    std::set<fs::path> touched;
    for (const auto& [file, list] : scenes_[scene])
        touched.insert(file);
    scenes_.erase(scene);
    return publish(touched, documents);
}

std::vector<Json> DiagnosticBoard::publish(const std::set<fs::path>& touched,
                                           const Documents& documents) const {
    std::vector<Json> notifications;
    for (const fs::path& file : touched) {
        Json list = Json::array();
        for (const auto& [scene, files] : scenes_)
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

} // namespace tidemark::lsp
