#include <catch2/catch.hpp>
#include <cstring>
#include <random>
#include <stdexcept>

#include "tables/files/atomic_file.hpp"
#include "tables/records/npy.hpp"
#include "tables/records/packed_rows.hpp"
#include "tables/records/record_format.hpp"
#include "tests/support/program.hpp"
#include "tests/support/sample_records.hpp"

using namespace irido;
using namespace irido::tables;
using namespace irido::test;
using Catch::Contains;
using Catch::StartsWith;

namespace {

/// A stream of that many rows, split at random.
std::string streamed(const RecordFormat& format, std::uint64_t rows, unsigned seed) {
    std::mt19937 random(seed);
    const RecordLayout layout = sample_layout();
    std::string out = format.head(layout, rows, HeadKind::open);
    bool has_rows = false;
    for (std::uint64_t done = 0; done < rows;) {
        const std::uint64_t count = std::min<std::uint64_t>(random() % 9, rows - done);
        const std::string block = format.rows(layout, sample_rows(done, count));
        if (has_rows && !block.empty()) out += format.separator;
        has_rows |= !block.empty();
        out += block;
        done += count;
    }
    return out.append(format.tail);
}

std::string as_h5(const TemporaryFolder& folder, const std::string& packed, std::uint64_t rows) {
    const RecordFormat& h5 = *find_record_format("h5");
    write_text(folder / "part", packed);
    h5.finish(sample_layout(), rows, folder / "part", folder / "out.h5");
    return folder / "out.h5";
}

}  // namespace

TEST_CASE("blocks of a stream make the file that is written at once", "[tables][stream]") {
    for (const std::uint64_t rows : {0, 1, 2, 7, 100})
        for (const unsigned seed : {1U, 2U, 3U}) {
            const Records all = sample_rows(0, rows);
            CHECK(streamed(*find_record_format("csv"), rows, seed) ==
                  written(*find_record_format("csv"), all));
            CHECK(streamed(*find_record_format("json"), rows, seed) ==
                  written(*find_record_format("json"), all));
            for (const char* const name : {"npy", "h5"}) {
                const RecordFormat& format = *find_record_format(name);
                CHECK(streamed(format, rows, seed) ==
                      format.head(sample_layout(), rows, HeadKind::open) +
                          format.rows(sample_layout(), all));
            }
        }
    CHECK(find_record_format("svg") == nullptr);
}

TEST_CASE("the head of an npy stream has one length for any number of rows", "[tables][stream]") {
    const RecordFormat& npy = *find_record_format("npy");
    const std::size_t length = npy.head(sample_layout(), 0, HeadKind::open).size();
    CHECK(length % 64 == 0);
    for (const std::uint64_t rows : {1ULL, 99999ULL, 100000000ULL, ~0ULL}) {
        const std::string head = npy.head(sample_layout(), rows, HeadKind::open);
        CHECK(head.size() == length);
        CHECK(head.substr(0, 8) == std::string("\x93NUMPY\x01\x00", 8));
        CHECK(static_cast<unsigned char>(head[8]) + 256U * static_cast<unsigned char>(head[9]) ==
              length - 10);
        CHECK_THAT(head, Contains("'shape': (" + std::to_string(rows) + ",), }"));
        CHECK(head.back() == '\n');
    }
    CHECK_THAT(npy.head(sample_layout(), 5, HeadKind::open),
               Contains(R"([('angle, degrees', '<f8'), ('it\'s', '<U12'), ('is_good', '|b1'), )"
                        R"(('\U000003bb_nm', '<f8'), ('kind', '<U11'), ('layers.0.n', '<f8'), ])"));
}

TEST_CASE("NumPy reads an npy stream, and one of very many columns", "[tables][stream]") {
    const TemporaryFolder folder;
    write_text(folder / "rows.npy", streamed(*find_record_format("npy"), 50, 1));
    write_text(folder / "rows.json", streamed(*find_record_format("json"), 50, 2));
    const Outcome read = run_shell(
        "/usr/bin/python3 -c 'import numpy, json\n"
        "a = numpy.load(\"rows.npy\")\n"
        "b = json.load(open(\"rows.json\", encoding=\"utf-8\"))\n"
        "print([dict(zip(a.dtype.names, row.tolist())) for row in a] == b, len(b))'",
        folder.path());
    INFO(read.err);
    CHECK(read.out == "True 50\n");
    RecordLayout wide;
    for (int i = 0; i < 3000; ++i)
        wide.push_back({"column-" + std::to_string(i), RecordField::Type::number, 0});
    const std::string head = find_record_format("npy")->head(wide, 0, HeadKind::open);
    CHECK(head.size() > 0xFFFF);
    write_text(folder / "wide.npy", head);
    const Outcome many = run_shell(
        "/usr/bin/python3 -c 'import numpy\n"
        "a = numpy.load(\"wide.npy\", max_header_size=10**6)\n"
        "print(a.shape, len(a.dtype.names))' 2> /dev/null",
        folder.path());
    CHECK(many.out == "(0,) 3000\n");
}

TEST_CASE("records that their layout does not allow are refused", "[tables][stream]") {
    const RecordLayout layout = sample_layout();
    for (const RecordFormat* const format : record_formats()) {
        INFO(format->name);
        Records records = sample_rows(0, 20);
        std::get<Column::Texts>(records.columns[1].values)[3] = "thirteen char";
        CHECK_THROWS_AS(format->rows(layout, records), std::logic_error);
        std::get<Column::Texts>(records.columns[1].values)[3] = "twelve chars";
        CHECK_NOTHROW(format->rows(layout, records));
        std::get<Column::CodedTexts>(records.columns[4].values).values[0] = "twelve chars";
        CHECK_THROWS_AS(format->rows(layout, records), std::logic_error);
        records = sample_rows(0, 20);
        std::swap(records.columns[0].values, records.columns[2].values);
        CHECK_THROWS_AS(format->rows(layout, records), std::logic_error);
        records = sample_rows(0, 20);
        records.columns[0].name = "angle";
        CHECK_THROWS_AS(format->rows(layout, records), std::logic_error);
        records.columns.pop_back();
        CHECK_THROWS_AS(format->rows(layout, records), std::logic_error);
    }
}

TEST_CASE("texts of UTF-8 become code points, others are refused", "[tables][stream]") {
    CHECK(code_points("a\xc3\xa9\xe6\xb3\xa1\xf0\x9f\xab\xa7") == U"a\u00e9\u6ce1\U0001FAE7");
    CHECK(code_points("\xf4\x8f\xbf\xbf\xed\x9f\xbf") == U"\U0010FFFF\ud7ff");
    // truncated, overlong, a surrogate, too large, a lone continuation byte
    for (const char* const text : {"\xc3", "\xe6\xb3", "\xf0\x9f\xab", "\xc3(", "\xc0\xaf",
                                   "\xe0\x80\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\x80"})
        CHECK_THROWS_AS(code_points(text), std::invalid_argument);
}

TEST_CASE("an HDF5 stream has one dataset a column with the CSV's values", "[tables][stream]") {
    const TemporaryFolder folder;
    for (const std::uint64_t rows : {0, 1, 50}) {
        INFO(rows);
        const H5Content content =
            read_h5(as_h5(folder, streamed(*find_record_format("h5"), rows, 5), rows));
        CHECK(content.faults.empty());
        const Records all = sample_rows(0, rows);
        const RowWriter writer(
            all, [](std::string& out, const std::string& text) { out += text; }, "");
        REQUIRE(content.columns.size() == all.columns.size());
        for (std::size_t c = 0; c < all.columns.size(); ++c) {
            CHECK(content.columns[c].name == all.columns[c].name);
            REQUIRE(content.columns[c].values.size() == rows);
            for (std::size_t row = 0; row < rows; ++row) {
                std::string wanted;
                writer.append(wanted, c, row);
                if (content.columns[c].type == "enum of 2, bytes 1")
                    wanted = wanted == "true" ? "TRUE" : "FALSE";
                CHECK(content.columns[c].values[row] == wanted);
            }
        }
        std::vector<std::string> types;
        for (const H5Column& column : content.columns) types.push_back(column.type);
        CHECK(types == std::vector<std::string>{"float64", "UTF-8 in 12", "enum of 2, bytes 1",
                                                "float64", "UTF-8 in 11", "float64"});
    }
}

TEST_CASE("an HDF5 stream of more rows than a buffer holds", "[tables][stream]") {
    const TemporaryFolder folder;
    const RecordFormat& h5 = *find_record_format("h5");
    constexpr std::uint64_t rows = 120000;  // 48 bytes each: more than 4 MiB
    const Records all = sample_rows(0, rows);
    const H5Content content = read_h5(as_h5(folder, h5.rows(sample_layout(), all), rows));
    const auto& sines = std::get<Column::Numbers>(all.columns[5].values);
    std::size_t wrong = 0;
    for (std::size_t row = 0; row < rows; ++row)
        if (std::stod(content.columns[5].values[row]) != sines[row]) ++wrong;
    CHECK(wrong == 0);
}

TEST_CASE("formats that find columns by name number those of one name", "[tables][stream]") {
    const Records records{{{"b", Column::Numbers{1}},
                           {"b", Column::Numbers{2}},
                           {"b_2", Column::Numbers{3}},
                           {"b", Column::Numbers{4}}}};
    const auto of = [&](const char* format) {
        return written(*find_record_format(format), records);
    };
    CHECK(of("csv") == "b,b,b_2,b\n1,2,3,4\n");
    CHECK(of("json") == "[\n{\"b\":1,\"b_3\":2,\"b_2\":3,\"b_4\":4}\n]\n");
    CHECK_THAT(of("npy"), Contains("('b', '<f8'), ('b_3', '<f8'), ('b_2', '<f8'), ('b_4', '<f8')"));
    const TemporaryFolder folder;
    const RecordFormat& h5 = *find_record_format("h5");
    write_text(folder / "part", h5.rows(layout_of(records), records));
    h5.finish(layout_of(records), 1, folder / "part", folder / "x.h5");
    std::vector<std::string> names;
    const H5Content content = read_h5(folder / "x.h5");
    for (const H5Column& column : content.columns)
        names.push_back(column.name + "=" + column.values[0]);
    CHECK(names == std::vector<std::string>{"b=1", "b_3=2", "b_2=3", "b_4=4"});
}

TEST_CASE("HDF5 refuses names that it cannot have, before the first row", "[tables][stream]") {
    const RecordFormat& h5 = *find_record_format("h5");
    for (const char* const name : {"", ".", "R/T"})
        CHECK_THROWS_WITH(h5.head({{name, RecordField::Type::number, 0}}, 0, HeadKind::open),
                          StartsWith("h5: a column cannot be named"));
}
