#include "schemas/readers/points_csv.hpp"

#include <catch2/catch.hpp>
#include <chrono>

#include "core/error.hpp"
#include "schemas/input_error.hpp"

using namespace irido;
using namespace irido::schemas;

namespace {

using Numbers = std::vector<double>;
using Texts = std::vector<std::string>;
using Codes = std::vector<std::uint32_t>;

std::vector<PointsColumn> read(const std::string& text) {
    return read_points_csv(text, "p.csv");
}

std::string error_of(const std::string& text) {
    try {
        read(text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

}  // namespace

TEST_CASE("columns of points are numbers or texts", "[points]") {
    const auto columns = read("a.0,substrate,b\n1,Ag,5\n+2.5e0,1.5,Au\n-.5,Ag,1e-3\n");
    REQUIRE(columns.size() == 3);
    CHECK(columns[0].path == "a.0");
    CHECK(columns[0].numbers == Numbers{1, 2.5, -0.5});
    CHECK((columns[0].texts.empty() && columns[0].codes.empty()));
    CHECK(columns[1].path == "substrate");
    CHECK(columns[1].numbers.empty());
    CHECK(columns[1].texts == Texts{"Ag", "1.5"});
    CHECK(columns[1].codes == Codes{0, 1, 0});
    // numbers before the first string are strings as written
    CHECK(columns[2].texts == Texts{"5", "Au", "1e-3"});
    CHECK(columns[2].codes == Codes{0, 1, 2});
}

TEST_CASE("points may be written in all the ways of RFC 4180", "[points]") {
    for (const std::string text :
         {"x,y\n1,\"{\"\"n\"\": 1.5, \"\"k\"\": 2}\"\n2,\"a\nb\"\"\"\n",
          "\xEF\xBB\xBFx,y\r\n1,\"{\"\"n\"\": 1.5, \"\"k\"\": 2}\"\r\n2,\"a\nb\"\"\"\r\n",
          "\n  \n \"x\" ,\ty \n\r\n\"1\" , \"{\"\"n\"\": 1.5, \"\"k\"\": 2}\"\t\n \n "
          "2,\"a\nb\"\"\" "
          "\n\n \t",
          "x,y\n1,\"{\"\"n\"\": 1.5, \"\"k\"\": 2}\"\n2,\"a\nb\"\"\""}) {
        CAPTURE(text);
        const auto columns = read(text);
        REQUIRE(columns.size() == 2);
        CHECK(columns[0].path == "x");
        CHECK(columns[0].numbers == Numbers{1, 2});
        CHECK(columns[1].path == "y");
        CHECK(columns[1].texts == Texts{"{\"n\": 1.5, \"k\": 2}", "a\nb\""});
    }
    // quoted blanks are kept, and the text around them is then not a number
    CHECK(read("\"a,b\"\n\" 1\"\n")[0].path == "a,b");
    CHECK(read("a\n\" 1\"\n")[0].texts == Texts{" 1"});
}

TEST_CASE("points that are no table are refused at line and column", "[points][refused]") {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"", "1:1: must have a header that names the columns"},
        {"\xEF\xBB\xBF\n \n", "1:1: must have a header that names the columns"},
        {"a,b\n", "1:1: has no rows below its header"},
        {"a,b", "1:1: has no rows below its header"},
        {"a,,c\n1,2,3\n", "1:3: the name of a column must not be empty"},
        {"a,b,a\n1,2,3\n", "1:5: duplicate column 'a'"},
        {"a,\"a\"\n1,2\n", "1:3: duplicate column 'a'"},
        {"100,1.5\n200,1.6\n", "1:1: the first row must name the columns (got '100')"},
        {"a,2\n3,4\n", "1:3: the first row must name the columns (got '2')"},
        {"a,b\n1,2\n\n1\n", "4:1: must have as many cells as the header, 2 (got 1)"},
        {"a,b\n1,2,\n", "2:1: must have as many cells as the header, 2 (got 3)"},
        {"a,b\n1,{\"n\":2}\n",
         "2:4: a cell that contains quotes must be quoted, with its quotes doubled (got "
         "'{\"n\":2}')"},
        {"a,b\n1, \n", "2:4: a cell must not be empty"},
        {"a,b\n1,\"\"\n", "2:3: a cell must not be empty"},
        {"a\n\"\"\n", "2:1: a cell must not be empty"},
        {"a\n1\n\n  \"2\n3\n", "4:3: the quote is never closed"},
        {"a\n\"1\"2\n", "2:4: a closing quote must be followed by a comma or the end of the line"},
        {"a\n\"\xC3\xA9\",1\n", "2:1: must have as many cells as the header, 1 (got 2)"},
        {"a,b\n\xC3\xA9,\n", "2:3: a cell must not be empty"},
        {"a,b\n\"x\ny\",nan\n", "3:4: must be a finite number in double precision (got 'nan')"},
    };
    for (const auto& [text, error] : cases) {
        CAPTURE(text);
        CHECK(error_of(text) == "p.csv: " + error);
    }
    for (const std::string number :
         {"nan", "NaN", "-inf", "+Infinity", "1e999", "-1e999", "1e-999", "\"nan\"", "nan(1)"}) {
        CAPTURE(number);
        CHECK_THAT(error_of("a\nAg\n" + number + "\n"),
                   Catch::StartsWith("p.csv: 3:1: must be a finite number"));
    }
    CHECK(error_of("a\nnano\n1.80-17\n0x10\n") == "accepted");
}

TEST_CASE("a million points are read in about half a second", "[points]") {
    std::string text = "a,b,c,substrate\n";
    for (int i = 0; i < 1000000; ++i) {
        const std::string x = to_text(1 + 1e-6 * i);
        text.append(x).append(",").append(x).append(",").append(x).append(",");
        text.append(i % 2 == 0 ? "Ag\n" : "Au\n");
    }
    const auto start = std::chrono::steady_clock::now();
    const auto columns = read(text);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    REQUIRE(columns[0].numbers.size() == 1000000);
    CHECK(columns[2].numbers.capacity() < 1100000);
    CHECK(columns[0].numbers[999999] == 1 + 1e-6 * 999999);
    CHECK(columns[3].texts == Texts{"Ag", "Au"});
    CHECK(columns[3].codes.size() == 1000000);
    CHECK(seconds.count() < 20);  // sanitizers take ten times longer
}
