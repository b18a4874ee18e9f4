! Nothing for ordinary points: what AUTO's arithmetic alone costs.
subroutine other_line(ibr, ntot, par, vaxis, u)
  implicit none
  integer, intent(in) :: ibr, ntot
  double precision, intent(in) :: par(*), vaxis, u(*)
end subroutine other_line
