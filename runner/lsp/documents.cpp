#include "lsp/documents.hpp"

#include "base/file.hpp"
#include "base/uri.hpp"
#include "text/mapped_text.hpp"

#include <utility>

namespace tidemark::lsp {
namespace fs = std::filesystem;

fs::path canonical_name(const fs::path& file) {
    std::error_code error;
    fs::path path = fs::weakly_canonical(file, error);
    return error ? file.lexically_normal() : path;
}

void Documents::hold(const fs::path& file, Document document, std::string text) {
    const fs::path name = canonical_name(file);
    open_[name] = std::move(document);
    texts_[name] = text::with_plain_line_ends(std::move(text));
}

void Documents::release(const fs::path& file) {
    const fs::path name = canonical_name(file);
    open_.erase(name);
    texts_.erase(name);
}

const Document* Documents::find(const fs::path& file) const {
    const auto found = open_.find(canonical_name(file));
    return found == open_.end() ? nullptr : &found->second;
}

Result<std::string> Documents::text_of(const fs::path& file) const {
    const auto held = texts_.find(canonical_name(file));
    if (held != texts_.end())
        return held->second;
    return read_text_file(file).map(text::with_plain_line_ends);
}

std::string Documents::uri_of(const fs::path& file) const {
    const Document* document = find(file);
    return document ? document->uri : uri_reference(canonical_name(file));
}

} // namespace tidemark::lsp
