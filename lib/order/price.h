// What a separator will cost.
//
// Eliminated after both sides, a separator S meets all outer vertices B of its piece (piece.h), so that with s and b
// their scalar dimensions it costs
//
//     ((s + b)^3 - b^3) / 3 = s^3 / 3 + s^2 b + s b^2,
//
// and each side X is a piece with the outer vertices N(X), those of S among them. What a side will cost is foretold by
// the same formula all the way down: it is halved again and again by separators of c w^gamma for w scalars, and each half
// has half the outer vertices and the separator around it. By this price, not by size and halves, separators compete: on
// a wide graph most is paid for what separators leave around the pieces below them.
//
// With w given, what is foretold is a polynomial of degree two in b. Its coefficients are tabulated once a piece, so
// that a move of one vertex is priced in a few nanoseconds.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lib/order/piece.h"

namespace sg::order {

// Scalar dimensions of what a separation makes of a piece.
struct Sizes {
  std::array<std::int64_t, 2> side{};   // inner vertices of the sides
  std::array<std::int64_t, 2> outer{};  // outer vertices that the sides meet
  std::int64_t separator = 0;           // which the sides meet, too

  std::int64_t inner() const { return side[0] + side[1] + separator; }
};
Sizes sizes(const Piece& piece, const Separation& side);

// The same while vertices change sides.
struct Tally {
  Sizes sizes;
  std::array<std::vector<Index>, 2> meets;  // of every outer vertex: neighbours on that side
};
Tally tally(const Piece& piece, const Separation& side);
// Vertex v goes from a side, or the separator, to another.
void change(const Piece& piece, Index v, char from, char to, Tally& tally);

struct Prices {
  double outer;                                 // scalars of the piece's outer vertices
  double step;                                  // between entries of the table
  std::vector<std::array<double, 3>> foretold;  // coefficients of 1, b, b^2
};
// separator: what one that halves the piece is expected to weigh.
Prices prices(const Piece& piece, double separator);

// A side may have so much of its piece: what is foretold of pieces halved again and again says little of others.
constexpr double largest_share = 0.8;

// Infinite where a side is empty, or has more than its share.
double price(const Prices& prices, const Sizes& sizes);

}  // namespace sg::order
