"""What is written for other programs; the entry is `support_exudyn.export`."""
