// Messages of the language server protocol on their way: JSON-RPC 2.0, each behind a header with its length.
#pragma once

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace tidemark::lsp {

using Json = nlohmann::json;

/// JSON-RPC's codes, and the protocol's own.
enum class ErrorNumber {
    parse_error = -32700,
    invalid_request = -32600,
    method_not_found = -32601,
    invalid_params = -32602,
    not_initialized = -32002,
    request_failed = -32803,
};

/// With its header. What is no UTF-8 is replaced.
std::string framed(const Json& message);

Json response(const Json& id, Json result);
Json error_response(const Json& id, ErrorNumber number, std::string_view message);
Json notification(std::string_view method, Json params);

/// Cuts what comes in into the texts of messages.
class MessageReader {
public:
    void feed(std::string_view bytes) { bytes_ += bytes; }
    /// The next whole one, which need not be JSON; nothing: more has to come.
    std::optional<std::string> next();
    /// The stream lost its frame: there is no way to find the next message.
    bool broken() const { return broken_; }

private:
    std::string bytes_;
    bool broken_ = false;
};

} // namespace tidemark::lsp
