// Loaded before a program that valgrind is to run: while Highway is loaded it asks the processor's clock how fine it
// is, by an instruction (rdtscp) that valgrind does not know on every processor. Nobody here asks for the answer.
namespace hwy::platform {

double TimerResolution();
double TimerResolution() {
  return 1e-9;
}

}  // namespace hwy::platform
