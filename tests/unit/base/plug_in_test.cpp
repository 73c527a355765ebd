#include "base/dynamic_library.hpp"
#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>

namespace tidemark::plug_in_test {

PlugIn plug_in(const char* file) {
    return {file, "picture plug-in", "reading and writing pictures", "OpenImageIO 2.4", "tidemark_none", 1};
}

TEST(PlugIn, a_missing_plug_in_names_the_searched_folders_and_a_remedy) {
    const auto missing =
        load_plug_in(plug_in("tidemark_nothing.so"), {"/nowhere/bin", "/nowhere/lib/tidemark"});
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::load);
    EXPECT_EQ(missing.error().message,
              "reading and writing pictures needs the plug-in 'tidemark_nothing.so', which is not in "
              "'/nowhere/bin', '/nowhere/lib/tidemark', or where the system looks for libraries; reinstall "
              "Tidemark or put the plug-in beside the program");
}

TEST(PlugIn, a_file_that_is_not_a_library_gives_the_loaders_reason) {
    const TemporaryFolder folder;
    const std::string file = folder / "tidemark_broken.so";
    save_in_place(file, "not a library");
    const auto broken = load_plug_in(plug_in("tidemark_broken.so"), {folder.path()});
    ASSERT_FALSE(broken);
    EXPECT_EQ(broken.error().message, "cannot load the picture plug-in '" + file + "': " + file +
                                          ": file too short; install OpenImageIO 2.4 and the plug-in of this "
                                          "build of Tidemark");
}

TEST(PlugIn, a_foreign_library_is_refused) {
    const auto foreign = load_plug_in(plug_in("libm.so.6"), {});
    ASSERT_FALSE(foreign);
    EXPECT_EQ(foreign.error().message,
              "cannot load the picture plug-in 'libm.so.6': it is not a plug-in of Tidemark; install "
              "OpenImageIO 2.4 and the plug-in of this build of Tidemark");
}

} // namespace tidemark::plug_in_test
