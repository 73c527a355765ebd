// The texts that the editor holds; all other texts come from their files.
#pragma once

#include "base/result.hpp"
#include "lsp/message.hpp"
#include "scene/load_options.hpp"

#include <filesystem>
#include <map>
#include <string>

namespace tidemark::lsp {

struct Document {
    std::string uri; ///< as the editor spells it
    int version = 0;
};

class Documents {
public:
    void hold(const std::filesystem::path& file, Document document, std::string text);
    void release(const std::filesystem::path& file);

    /// Returns nullptr if the editor does not hold the file.
    const Document* find(const std::filesystem::path& file) const;
    /// Returns the text with every line end as one `\n`, so that offsets do not depend on the editor.
    Result<std::string> text_of(const std::filesystem::path& file) const;
    std::string uri_of(const std::filesystem::path& file) const;

    const scene::UnsavedTexts& texts() const { return texts_; }
    const std::map<std::filesystem::path, Document>& open() const { return open_; }

private:
    std::map<std::filesystem::path, Document> open_;
    scene::UnsavedTexts texts_;
};

/// Returns the one path under which a file is stored here.
std::filesystem::path canonical_name(const std::filesystem::path& file);

} // namespace tidemark::lsp
