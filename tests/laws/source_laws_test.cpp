// SPDX-License-Identifier: MIT
#include <batten/tests/laws/source_laws.h>
#include <batten/tests/laws/source_text.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace batten {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;

const std::string licence = "// SPDX-License-Identifier: MIT\n";
const std::string header = licence + "#pragma once\n";
const std::filesystem::path root = BATTEN_SOURCE_DIR;

std::string read(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<std::string> faults(const std::string& name, const std::string& text) {
  std::vector<std::string> texts;
  for (const Violation& violation : violations_of(name, text)) texts.push_back(violation.text);
  return texts;
}

std::string lines(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += "  x = '{' + \"}\"; // }\n";
  return text;
}

std::vector<int> function_lengths(const std::string& text) {
  std::vector<int> lengths;
  for (const FunctionExtent& function : functions_of(read_source(text))) lengths.push_back(function.lines);
  return lengths;
}

TEST(Sources, are_found) {
  EXPECT_THAT(source_files(root), IsSupersetOf({"domains/errors.h", "tests/laws/source_laws_test.cpp"}));
}

TEST(Sources, keep_the_laws_of_the_house) {
  std::ostringstream found;
  for (const std::string& name : source_files(root)) {
    for (const Violation& violation : violations_of(name, read(root / name))) found << violation << '\n';
  }
  EXPECT_EQ(found.str(), "");
}

TEST(SourceLaws, accept_what_is_allowed) {
  EXPECT_THAT(faults("fem/a.h", header + "#include <batten/bases/mask.h>\n#include <Eigen/Dense>\n#include <vector>\n"),
              IsEmpty());
  EXPECT_THAT(faults("fem/a.cpp", licence + "#include <Eigen/CholmodSupport>\n#include <cholmod.h>\n"), IsEmpty());
  EXPECT_THAT(faults("io/a.cpp", licence + "#include <vtkPoints.h>\n#include <batten/domains/record.h>\n"), IsEmpty());
  EXPECT_THAT(faults("bases/rational.h", header + "#include <boost/multiprecision/gmp.hpp>\n"), IsEmpty());
  EXPECT_THAT(faults("tests/support/laws.h", header + "#include <gmock/gmock.h>\n"), IsEmpty());
  EXPECT_THAT(faults("tests/fem/a.cpp", licence + "#include \"b.h\"\n#include \"../support/laws.h\"\n"), IsEmpty());
}

TEST(SourceLaws, reject_an_upward_include) {
  const auto fault = [](const std::string& name, const std::string& folder) {
    return faults(name, licence + "#  include <batten/" + folder + "/a.h>  // why\n");
  };
  EXPECT_THAT(fault("domains/a.cpp", "bases"), ElementsAre("include <batten/bases/a.h>: domains must not see bases"));
  EXPECT_THAT(fault("bases/a.cpp", "fem"), ElementsAre(HasSubstr("bases must not see fem")));
  EXPECT_THAT(fault("io/a.cpp", "bases"), ElementsAre(HasSubstr("io must not see bases")));
  EXPECT_THAT(fault("fem/a.cpp", "io"), ElementsAre(HasSubstr("fem must not see io")));
  EXPECT_THAT(fault("fem/a.cpp", "app"), ElementsAre(HasSubstr("fem must not see app")));
  EXPECT_THAT(fault("app/a.cpp", "tests"), ElementsAre(HasSubstr("app must not see tests")));
}

TEST(SourceLaws, reject_own_headers_by_other_names) {
  EXPECT_THAT(faults("fem/a.cpp", licence + "#include \"b.h\"\n"), ElementsAre(HasSubstr("<batten/folder/name.h>")));
  EXPECT_THAT(faults("fem/a.cpp", licence + "#include <../io/b.h>\n"), ElementsAre(HasSubstr("<batten/folder")));
  EXPECT_THAT(faults("fem/a.cpp", licence + "#include HEADER\n"), ElementsAre(HasSubstr("<batten/folder")));
  EXPECT_THAT(faults("tests/fem/a.cpp", licence + "#include \"../../fem/b.h\"\n"), ElementsAre(HasSubstr("<batten/")));
}

TEST(SourceLaws, reject_third_party_headers_in_headers) {
  for (const std::string include :
       {"<vtkPoints.h>", "<CGAL/Kernel.h>", "<cholmod.h>", "<Eigen/CholmodSupport>", "<CLI/CLI.hpp>",
        "<nlohmann/json.hpp>", "<boost/multiprecision/gmp.hpp>", "<gtest/gtest.h>", "<omp.h>", "<gmp.h>"}) {
    for (const std::string name : {"domains/a.h", "fem/a.h", "io/a.h", "app/a.h"}) {
      EXPECT_THAT(faults(name, header + "#include " + include + "\n"), Contains(HasSubstr(include))) << name;
    }
  }
}

TEST(SourceLaws, confine_libraries_to_their_folders) {
  EXPECT_THAT(faults("fem/a.cpp", licence + "#include <vtkPoints.h>\n"), ElementsAre(HasSubstr("must not see VTK")));
  EXPECT_THAT(faults("app/a.cpp", licence + "#include <vtkPoints.h>\n"), ElementsAre(HasSubstr("must not see VTK")));
  EXPECT_THAT(faults("fem/a.cpp", licence + "#include <CGAL/K.h>\n"), ElementsAre(HasSubstr("must not see CGAL")));
  EXPECT_THAT(faults("fem/a.cpp", licence + "#include <Clp_C_Interface.h>\n"),
              ElementsAre(HasSubstr("must not see Clp")));
  EXPECT_THAT(faults("io/a.cpp", licence + "#include <suitesparse/cholmod.h>\n"),
              ElementsAre(HasSubstr("must not see SuiteSparse")));
  EXPECT_THAT(faults("fem/a.cpp", licence + "#include <toml++/toml.h>\n"),
              ElementsAre(HasSubstr("must not see toml++")));
  EXPECT_THAT(faults("io/a.cpp", licence + "#include <muParser.h>\n"), ElementsAre(HasSubstr("must not see muParser")));
}

TEST(SourceLaws, do_not_read_comments) {
  EXPECT_THAT(faults("fem/a.cpp", licence + "// #include <vtkPoints.h>\n/*\n#include \"a.h\"\n*/\n"), IsEmpty());
}

TEST(SourceLaws, ask_for_licence_and_pragma_once) {
  EXPECT_THAT(faults("fem/a.h", "#pragma once\n"), ElementsAre(HasSubstr("SPDX")));
  EXPECT_THAT(faults("fem/a.h", licence), ElementsAre("a header needs #pragma once"));
  EXPECT_THAT(faults("fem/a.hpp", licence), ElementsAre("sources end in .h or .cpp"));
  EXPECT_THAT(faults("utils/a.cpp", licence), ElementsAre("no such folder in the house"));
}

TEST(SourceLaws, bound_the_length_of_files) {
  EXPECT_THAT(faults("fem/a.h", header + std::string(148, '\n')), IsEmpty());
  EXPECT_THAT(faults("fem/a.h", header + std::string(149, '\n')), ElementsAre("151 lines, 150 are allowed"));
  EXPECT_THAT(faults("fem/a.cpp", licence + std::string(399, '\n')), IsEmpty());
  EXPECT_THAT(faults("fem/a.cpp", licence + std::string(400, '\n')), ElementsAre("401 lines, 400 are allowed"));
}

TEST(SourceLaws, bound_the_length_of_functions) {
  const std::string before = licence + "namespace a {\nint f(int x) {\n";
  EXPECT_THAT(faults("fem/a.cpp", before + lines(58) + "}\n}\n"), IsEmpty());
  EXPECT_THAT(faults("fem/a.cpp", before + lines(59) + "}\n}\n"),
              ElementsAre("a function of 61 lines, 60 are allowed"));
}

TEST(FunctionLengths, are_counted_from_the_declaration_to_the_closing_brace) {
  EXPECT_THAT(function_lengths("int f() { return 1; }\n\n/// g\nint g(\n  int a)\n{\n}\n"), ElementsAre(1, 4));
  EXPECT_THAT(function_lengths("class A {\npublic:\n  // note\n  A() {\n  }\n  int g() const;\n};\n"), ElementsAre(2));
  EXPECT_THAT(function_lengths("template <class T>\nrequires B<T>\nstruct A {\n  void f() {\n\n  }\n};\n"),
              ElementsAre(3));
  EXPECT_THAT(function_lengths("class alignas(8) A {\n  void f() {\n  }\n\n\n};\n"), ElementsAre(2));
  EXPECT_THAT(function_lengths("extern \"C\" {\nvoid f() {\n}\n\n}\n"), ElementsAre(2));
  EXPECT_THAT(function_lengths("TEST(A, b) {\n  if (x) {\n  }\n}\n"), ElementsAre(4));
}

TEST(FunctionLengths, count_constructors_with_their_initialisers) {
  EXPECT_THAT(function_lengths("A::A()\n    : a_{1},\n      b_(2) {\n  x;\n}\nvoid f() {\n}\n"), ElementsAre(2, 5, 2));
}

TEST(FunctionLengths, count_lambdas_as_functions) {
  EXPECT_THAT(function_lengths("const auto f = [](int a) {\n  return a;\n};\n"), ElementsAre(3));
  EXPECT_THAT(function_lengths("const auto f = [] {\n  return 1;\n};\n"), ElementsAre(3));
  EXPECT_THAT(function_lengths("const int a = call([&](int b) -> int {\n  return b;\n}, {1, 2});\n"), ElementsAre(3));
}

TEST(FunctionLengths, leave_out_tables_types_and_namespaces) {
  EXPECT_THAT(function_lengths("namespace {\nenum class A { B, C };\nconst int a[] = {\n  1,\n  2};\nint b{3};\n}\n"),
              IsEmpty());
}

TEST(FunctionLengths, are_not_misled_by_literals_and_directives) {
  EXPECT_THAT(function_lengths("int f() {\n  return '{' + R\"x(}\")x\"[0] + 1'000; /* } */\n}\nint g() {}\n"),
              ElementsAre(3, 1));
  EXPECT_THAT(function_lengths("#define BEGIN(a) \\\n  f() {\nint g() {\n}\n"), ElementsAre(2));
}

}  // namespace
}  // namespace batten
