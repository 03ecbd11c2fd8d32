"""What a state shows, to take away: its data as tables, its pictures as figures for paper."""
