// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/stroke_font.hpp"

#include <array>

namespace sks {
namespace {

constexpr char first = ' ', last = '~';

// Two digits are a point: x from 0 to 4, y from 0 to 8 with the baseline at 6. A space begins another stroke.
constexpr const char* glyph_points[] = {
    "", "2024 2626", "1012 3032", "1016 3036 0242 0444", "413010010213334445361605 2026", "0640 0101 4545",
    "4612112031320405162644", "2022", "30212536", "10212516", "2125 0244 0442", "2125 0343", "252617", "1333", "2626",
    "0640",
    // 0 to 9
    "100105163645413010", "112026 1636", "01103041420646", "0110304142334445361605 1333", "36300444",
    "400002324345361605", "413010010516364544331304", "004016", "13020110304142331304051636454433",
    "423313020110304145361605",
    // : to @
    "2222 2626", "2222 252617", "410345", "0242 0444", "014305", "01103041422324 2626", "4516050110304144242242",
    // A to Z
    "062046 1434", "00063645443303 3342413000", "4130100105163645", "00062644422000", "40000646 0333", "400006 0333",
    "41301001051636454323", "0006 4046 0343", "1030 2026 1636", "4045361605", "0006 400346", "000646", "0600234046",
    "06004640", "100105163645413010", "06003041423303", "100105163645413010 2446", "06003041423303 2346",
    "413010010213334445361605", "0040 2026", "000516364540", "002640", "0016233640", "0046 0640", "002340 2326",
    "00400646",
    // [ to `
    "30101636", "0046", "10303616", "022042", "0747", "1021",
    // a to z
    "4332120305163645 4246", "0006 0312324345361605", "4332120305163645", "4332120305163645 4046",
    "04444332120305163645", "40302126 0242", "4332120305163645 4247381807", "0006 0312324346", "2226 2020",
    "32372818 3030", "0006 420446", "10202536", "0206 03122326 23324346", "0206 0312324346", "120305163645433212",
    "0208 0312324345361605", "4248 4332120305163645", "0206 03123243", "43321203143445361605", "20253646 0242",
    "0205163645 4246", "022642", "0216233642", "0246 0642", "0226 421808", "02420646",
    // { to ~
    "30212213242536", "2026", "10212233242516", "04133443"};
constexpr std::size_t count = std::size_t(last - first) + 1;
static_assert(sizeof(glyph_points) / sizeof(glyph_points[0]) == count, "one entry for each character");

std::vector<Stroke> strokesOf(const char* points) {
  std::vector<Stroke> strokes;
  if (*points != '\0') strokes.emplace_back();
  for (; *points != '\0'; ++points) {
    if (*points == ' ') {
      strokes.emplace_back();
      continue;
    }
    const double x = *points++ - '0';
    strokes.back().emplace_back(x, *points - '0');
  }
  return strokes;
}

}  // namespace

const std::vector<Stroke>& glyph(char character) {
  static const auto glyphs = [] {
    std::array<std::vector<Stroke>, count> all;
    for (std::size_t i = 0; i < count; ++i) all[i] = strokesOf(glyph_points[i]);
    return all;
  }();
  const bool known = character >= first && character <= last;
  return glyphs[std::size_t((known ? character : '?') - first)];
}

}  // namespace sks
