// Files with cures: each as a difference to the one before, and none over what a person wrote meanwhile.
#include "base/file.hpp"
#include "cli/changed_files.hpp"
#include "support/temporary_folder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace tidemark::cli::changed_files_test {

glsl::Cure around(const std::string& file, int column, const std::string& word) {
    const glsl::WrittenWord there{{file, 1, column}, word};
    return {{{there, there, "(", ")"}}, ""};
}

TEST(CuredFiles, EachFixIsAppliedAfterTheEarlierFixes) {
    const TemporaryFolder folder;
    const std::string file = (folder.path() / "a.glsl").string();
    ASSERT_TRUE(write_file(OutputPath::typed(file), "x = y;\n"));
    CuredFiles cured;
    const std::vector<glsl::Cure> cures{around(file, 5, "y"), around(file, 1, "x")};
    const auto first = cured.with_last(std::span(cures).first(1));
    ASSERT_TRUE(first);
    EXPECT_EQ(first->front().after, "x = (y);\n");
    ASSERT_TRUE(write_files(*first));
    const auto second = cured.with_last(cures);
    ASSERT_TRUE(second);
    EXPECT_EQ(second->front().before, "x = (y);\n");
    EXPECT_EQ(second->front().after, "(x) = (y);\n");
    EXPECT_TRUE(write_files(*second));
}

TEST(CuredFiles, AFileChangedMeanwhileIsKept) {
    const TemporaryFolder folder;
    const std::string file = (folder.path() / "a.glsl").string();
    ASSERT_TRUE(write_file(OutputPath::typed(file), "x = y;\n"));
    CuredFiles cured;
    const glsl::Cure cure = around(file, 5, "y");
    const auto changed = cured.with_last(std::span(&cure, 1));
    ASSERT_TRUE(changed);
    ASSERT_TRUE(write_file(OutputPath::typed(file), "x = z;\n"));
    const auto written = write_files(*changed);
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().message,
              "'" + file + "' changed on disk meanwhile; nothing was written; the change is saved in '" +
                  file + ".diff'");
    EXPECT_EQ(read_text_file(file).value_or(""), "x = z;\n");
    const std::string difference = fmt::format("--- {0}\n+++ {0}\n@@ -1 +1 @@\n-x = y;\n+x = (y);\n", file);
    EXPECT_EQ(read_text_file(file + ".diff").value_or(""), difference);
    ASSERT_TRUE(write_file(OutputPath::typed(file + ".diff"), "mine"));
    EXPECT_FALSE(write_files(*changed));
    EXPECT_EQ(read_text_file(file + ".diff").value_or(""), "mine");
    EXPECT_EQ(read_text_file(file + ".2.diff").value_or(""), difference);
}

TEST(CuredFiles, MissingOriginalTextIsRefused) {
    const TemporaryFolder folder;
    const std::string file = (folder.path() / "a.glsl").string();
    ASSERT_TRUE(write_file(OutputPath::typed(file), "x = y;\n"));
    const glsl::Cure cure = around(file, 4, "y");
    EXPECT_FALSE(CuredFiles().with_last(std::span(&cure, 1)));
}

} // namespace tidemark::cli::changed_files_test
