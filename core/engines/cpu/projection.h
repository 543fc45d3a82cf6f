// Extended position-based dynamics on the lattice: Gauss-Seidel over springs that are coloured by the parity of their
// row or column, so that no two of a colour share a particle. The order of the colours is fixed, and threads work on
// rows that no other touches meanwhile: the same bits for any number of them.
#pragma once

#include "core/engines/cpu/band.h"
#include "core/engines/cpu/projection_rows.h"
#include "core/engines/cpu/team.h"

namespace tyglab::cpu {

template <class R>
class Projector {
 public:
  using Field = RowField<R>;

  /// Before a step, on one thread: which springs are whole and which particles free, where that is not all of them.
  /// `changed`: whether either may differ from the last step's.
  void prepare(const Cloth<R>& cloth, const Tears& tears, bool changed);
  /// Moves the displacements in vector q of rows [begin, end) until the springs have had their iterations. All threads
  /// together, each with its rows: begin is even, and so is end but for the last.
  void project(Cloth<R>& cloth, int q, int begin, int end, Team& team);
  /// What k_d takes of the velocities, likewise.
  void damp(Cloth<R>& cloth, int begin, int end, Team& team);
  std::size_t bytes() const;

 private:
  /// Where a colour of a direction begins, and how its springs lie.
  struct Colour {
    int direction;
    int first;   ///< row or column
    int lambda;  ///< which of lambda_
  };
  void project_colour(Cloth<R>& cloth, int q, const Colour& colour, int i);
  void damp_colour(Cloth<R>& cloth, const Colour& colour, int i);
  void project_weight(Cloth<R>& cloth, int q);
  template <class Row>
  bool place(const Cloth<R>& cloth, const Colour& colour, int i, Row& row, int& upper, int& lower) const;
  /// Does what each colour asks for in rows [begin, end), with a barrier between those that reach over to other rows.
  template <class Work>
  static void in_colours(int begin, int end, bool bending, Team& team, Work work);

  static constexpr int lambdas = 8;
  int rows_ = 0, stride_ = 0;
  Array<R> lambda_;  ///< a row's, colour after colour
  bool masked_ = false;
  Array<R> free_;   ///< of particles
  Array<R> whole_;  ///< of a row's springs, direction after direction
};

}  // namespace tyglab::cpu
