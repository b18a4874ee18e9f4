// `prescribed` in case files.
#include <gmock/gmock.h>

#include "case_files.hpp"

namespace springfold::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class PrescribedKey : public CaseFiles {
 protected:
  std::vector<std::string> about(const std::string& study) const {
    return messages(R"toml([[body]]
name = "tip"
task_space = "planar"
[[chain]]
name = "arm"
elements = [ { elastic = "beam", length = 1, E = 1, A = 1, Iz = 1 } ]
[[study]]
name = "s"
)toml" + study);
  }
};

TEST_F(PrescribedKey, NamesPoseCoordinates) {
  EXPECT_THAT(
      about("control = \"mixed\"\ndirection = [1, 0, 0.5]\nprescribed = [\"x\", \"phi\"]\n"),
      IsEmpty());
}

TEST_F(PrescribedKey, SaysWhatIsWrongWithIt) {
  EXPECT_THAT(about("control = \"mixed\"\ndirection = [1, 0, 0]\nprescribed = [\"x\", \"rz\"]\n"),
              ElementsAre("case.toml:11:14: study[1].prescribed: the body has no pose coordinate "
                          "\"rz\" (study \"s\")"));
  EXPECT_THAT(about("control = \"mixed\"\ndirection = [1, 0, 0]\nprescribed = \"x\"\n"),
              ElementsAre(HasSubstr("study[1].prescribed: got \"x\", need a list of pose "
                                    "coordinates such as [\"x\", \"rz\"]")));
  EXPECT_THAT(about("control = \"load\"\ndirection = [1, 0, 0]\nprescribed = [\"x\"]\n"),
              ElementsAre(HasSubstr("study[1].prescribed: has no meaning here, need control = "
                                    "\"mixed\" with it")));
  EXPECT_THAT(about("control = \"mixed\"\ndirection = [1, 0, 0.5]\n"),
              ElementsAre(HasSubstr("got a translation and a rotation together")));
}

}  // namespace
}  // namespace springfold::io
