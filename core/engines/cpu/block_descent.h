// Vertex block descent on the lattice. A pass visits the particles color by color, and each makes a step of
// Newton's method for the energy of implicit Euler's step (docs/model.md) in its own three coordinates. With the
// color (i + 2j) mod 5 no spring connects two particles of one color, so all of these move simultaneously, and the
// bits are identical for any number of threads. A. H. Chen, Z. Liu, Y. Yang, C. Yuksel, ACM Trans. Graph. 43, 116
// (2024).
//
// Each component of a row is stored in five parts, columns 0, 5, 10 …, then 1, 6, 11 … and so on, so particles of
// one color are adjacent in memory, and so are their neighbors in each direction.
#pragma once

#include <cstdint>
#include <vector>

#include "core/engines/cpu/band.h"
#include "core/engines/cpu/block_rows.h"
#include "core/engines/cpu/team.h"

namespace tyglab::cpu {

template <class R>
class BlockDescent {
 public:
  using Field = RowField<R>;
  static constexpr int colors = 5;

  /// Prepares a step over h, s, on one thread. `changed`: whether springs or fixed particles may differ from the last.
  void prepare(const Cloth<R>& cloth, const Tears& tears, double h, bool changed);
  /// Takes c_x and c_v of rows [begin, end), and begins where inertia alone leads.
  void begin(const Field& c_x, const Field& c_v, int begin, int end);
  /// Finds how far each piece of the cloth should fall before the first pass, on one thread: a particle between others
  /// that rest hardly falls, so that passes alone would hold back what falls as a whole.
  void weigh();
  /// Lets rows [begin, end) fall that far.
  void fall(int begin, int end);
  /// Takes `a`, of gravity and wind, in place of gravity alone.
  void accelerate(const Field& c_v, const Field& a, int begin, int end);
  /// A pass over all particles; called by all threads together, each with its rows.
  void pass(int begin, int end, Team& team);
  /// Writes the present x = c_x + q.
  void write_positions(Field& x, int begin, int end) const;
  /// Writes v = q/h of free particles.
  void write_velocities(Field& v, int begin, int end) const;
  std::size_t bytes() const;

 private:
  static constexpr int lanes = widest_vector / int(sizeof(R)), ghost_rows = 2;  // above and below
  /// Free particles that whole springs join, by way of free ones.
  struct Piece {
    double particles = 0;
    double falls = 0;  ///< by which share of what gravity would move it alone
    std::size_t held_begin = 0, held_end = 0;
  };
  /// A spring from a fixed particle to a free one.
  struct Held {
    std::size_t fixed, free;  ///< where their x stands in c_ and q_
    int kind;                 ///< as in BlockRow
    double linear;            ///< constant of LinearSprings
  };
  void make_masks(const Cloth<R>& cloth, const Tears& tears);
  void find_pieces(const Cloth<R>& cloth, const Tears& tears);
  /// The slope of the minimized energy where the piece has fallen by that share of gravity's way, over the way's
  /// square.
  double slope(const Piece& piece, double share) const;
  /// The force down on the free end of a spring, times h²/m, where its piece has fallen by `fallen`, m.
  double pull_down(const Held& spring, double fallen) const;
  /// Where column j of a component begins, from its row's begin.
  std::ptrdiff_t place(int j) const {
    // A column left of the first lies in the zeros before its part.
    const int part = ((j % colors) + colors) % colors;
    return part * part_ + lanes + (j - part) / colors;
  }
  std::ptrdiff_t component() const { return colors * part_; }
  std::size_t at(int i, int c, int j) const {
    return std::size_t((std::ptrdiff_t(i + ghost_rows) * 3 + c) * component() + place(j));
  }
  std::size_t mask_at(int i, int d, int j) const {
    return std::size_t((std::ptrdiff_t(i + ghost_rows) * std::ptrdiff_t(directions.size()) + d) * component() +
                       place(j));
  }
  void descend(int i, int part);

  int rows_ = 0, columns_ = 0;
  std::ptrdiff_t part_ = 0;  ///< numbers in a part: zeros, its columns, zeros up to a whole vector
  double h_ = 0, gravity_ = 0;
  BlockConstants constants_{};
  Array<R> c_, q_, y_;         ///< as in BlockRow
  Array<R> whole_;             ///< for each row its six directions: 1 where the particle owns a whole spring, else 0
  Array<R> linear_;            ///< likewise the constants of LinearSprings; empty if there are none
  std::uint64_t springs_ = 0;  ///< their version
  Array<R> free_;
  std::vector<int> piece_of_;  ///< of each particle
  std::vector<Piece> pieces_;
  std::vector<Held> held_;     ///< piece by piece
  std::vector<int> found_;     ///< of one piece while it is found
  bool pieces_known_ = false;  ///< not before there was memory for all of them
};

}  // namespace tyglab::cpu
