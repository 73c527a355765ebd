#include "cli/error_json.hpp"

#include <nlohmann/json.hpp>

namespace tidemark::cli {

Json to_json(const Error& error) {
    Json diagnostics = Json::array();
    for (const Diagnostic& d : error.diagnostics)
        diagnostics.push_back({d.where.file, d.where.line, d.where.column, int(d.severity), d.message});
    return {{"error", error.message}, {"code", int(error.code)}, {"diagnostics", diagnostics}};
}

std::optional<Error> error_of(const Json& line) {
    if (!line.contains("error"))
        return std::nullopt;
    Error error{ErrorCode(line.at("code").get<int>()), line.at("error").get<std::string>(), {}};
    for (const Json& d : line.at("diagnostics")) {
        Diagnostic& diagnostic = error.diagnostics.emplace_back();
        d[0].get_to(diagnostic.where.file);
        d[1].get_to(diagnostic.where.line);
        d[2].get_to(diagnostic.where.column);
        diagnostic.severity = Severity(d[3].get<int>());
        d[4].get_to(diagnostic.message);
    }
    return error;
}

} // namespace tidemark::cli
